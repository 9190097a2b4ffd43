/** The ND's own controls, as on an EFIS panel: mode and range. */

import { Choice } from "../parts";
import { ND_RANGES, type Session } from "../session";

export function Efis(props: { session: Session }) {
  const { ndMode, ndRange } = props.session;
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
        label="Range of the navigation display in nautical miles"
        options={ND_RANGES}
        chosen={ndRange.value}
        choose={(range) => {
          ndRange.value = range;
        }}
      />
      <span class="efis-unit" aria-hidden="true">
        NM
      </span>
    </div>
  );
}
