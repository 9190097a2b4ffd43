/** The ND's own controls, as on an EFIS panel: mode and range. */

import { Choice } from "../parts";
import { ND_RANGES, type Session } from "../session";

export function Efis(props: { session: Session }) {
  const { ndMode, ndRange, ndAuto } = props.session;
  return (
    <div class="efis">
      <span class="efis-label" aria-hidden="true">
        ND
      </span>
      <Choice
        label="Mode of the navigation display"
        options={["ROSE", "ARC"]}
        chosen={ndMode.value}
        choose={(mode) => {
          ndMode.value = mode;
        }}
      />
      <span class="efis-label efis-range" aria-hidden="true">
        RANGE
      </span>
      <Choice
        label="Range of the navigation display in nautical miles; AUTO fits it to the path"
        options={["AUTO", ...ND_RANGES]}
        chosen={ndAuto.value ? "AUTO" : ndRange.value}
        current={ndRange.value}
        choose={(choice) => {
          ndAuto.value = choice === "AUTO";
          if (choice !== "AUTO") ndRange.value = choice;
        }}
      />
      <span class="efis-unit" aria-hidden="true">
        NM
      </span>
    </div>
  );
}
