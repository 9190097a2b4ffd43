/** Which scenario is flown; choosing another starts it. Why one cannot be flown stands in Help. */

import type { Actions, Session } from "../session";

export function ScenarioPicker(props: { session: Session; actions: Actions }) {
  const { scenarios, status, recording } = props.session;
  const title = recording.value?.title ?? status.value?.title ?? "Scenario";
  const flown = status.value?.scenario ?? "";
  return (
    <div class="scenario">
      <label>
        <span class="visually-hidden">Scenario</span>
        <select value={flown} onChange={(event) => props.actions.start(event.currentTarget.value)}>
          {scenarios.value.every((scenario) => scenario.name !== flown) && (
            <option value={flown}>{title}</option>
          )}
          {scenarios.value.map((scenario) => (
            <option key={scenario.name} value={scenario.name} disabled={!scenario.available}>
              {scenario.title}
              {scenario.available ? "" : " (not available: see Help)"}
            </option>
          ))}
        </select>
      </label>
    </div>
  );
}
