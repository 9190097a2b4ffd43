/** Which scenario is flown; choosing another starts it. One that cannot be flown says why. */

import type { Actions, Session } from "../session";

export function ScenarioPicker(props: { session: Session; actions: Actions }) {
  const { scenarios, status } = props.session;
  const flown = status.value?.scenario ?? "";
  const missing = scenarios.value.filter((scenario) => !scenario.available);
  return (
    <div class="scenario">
      <label>
        <span class="visually-hidden">Scenario</span>
        <select value={flown} onChange={(event) => props.actions.start(event.currentTarget.value)}>
          {scenarios.value.every((scenario) => scenario.name !== flown) && (
            <option value={flown}>{status.value?.title ?? "Scenario"}</option>
          )}
          {scenarios.value.map((scenario) => (
            <option key={scenario.name} value={scenario.name} disabled={!scenario.available}>
              {scenario.title}
              {scenario.available ? "" : " (not available)"}
            </option>
          ))}
        </select>
      </label>
      {missing.length > 0 && (
        <details class="missing">
          <summary>{missing.length} not available: why?</summary>
          <div>
            {missing.map((scenario) => (
              <p key={scenario.name}>
                <b>{scenario.title}</b> {scenario.message}
              </p>
            ))}
          </div>
        </details>
      )}
    </div>
  );
}
