/** Four planners side by side: what each would fly from now on, what that costs, and where it fails. */

import { Choice, Panel, set } from "../parts";
import { PLANNERS } from "../planners";
import type { Session } from "../session";
import { formatClock, inPageUnits } from "../units";
import type { ComparedPlanner, PlannerVerdict, Verdict } from "../wire";

const NAMES: Record<ComparedPlanner, string> = {
  exact: "Exact",
  network: "Network",
  regular_dp: "Tree",
  printed_network: "Printed",
};

/** A sign and a word for each. */
const VERDICTS: Record<Verdict, readonly [string, string]> = {
  planned: ["\u2713", "certified"],
  refused: ["\u2715", "not flown"],
  handed_over: ["\u2192", "hands over to the exact planner"],
  no_plan: ["\u2013", "no plan"],
  preparing: ["\u2026", "being compiled"],
};

export function PlannersPanel(props: { session: Session }) {
  const { planners } = props.session;
  const { chosen, compared, trouble, isOpen } = planners;
  const verdicts = compared.value?.verdicts ?? [];
  const said = verdicts.find(({ planner }) => planner === chosen.value);
  return (
    <Panel
      name="alternatives"
      title="Planners"
      aside={
        <button type="button" class="link" onClick={set(isOpen, false)}>
          Alternatives
        </button>
      }
      scrolls
    >
      <Choice
        label="Planner that is drawn"
        kind="planners"
        options={PLANNERS}
        chosen={chosen.value}
        text={(planner) => NAMES[planner]}
        choose={(planner) => {
          chosen.value = planner;
        }}
      />
      {compared.value === null ? (
        <p class="hint">{trouble.value === "" ? "They are being asked." : trouble.value}</p>
      ) : (
        <table class="list">
          <caption>From {formatClock(compared.value.t)} on</caption>
          <thead>
            <tr>
              <th scope="col">Planner</th>
              <th scope="col">Joins</th>
              <th scope="col">Over</th>
              <th scope="col">Word</th>
              <th scope="col">ms</th>
              <th scope="col">
                <span class="visually-hidden">Verdict</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {verdicts.map((each) => (
              <Row key={each.planner} verdict={each} isChosen={each.planner === chosen.value} />
            ))}
          </tbody>
        </table>
      )}
      {said !== undefined && (
        <p class="proof" aria-live="polite">
          {NAMES[said.planner]}: {inPageUnits(said.message)}
        </p>
      )}
    </Panel>
  );
}

function Row({ verdict, isChosen }: { verdict: PlannerVerdict; isChosen: boolean }) {
  const { planner, status, word, time_to_converge_s, over_exact_s, compute_ms } = verdict;
  const [sign, meaning] = VERDICTS[status];
  const hasPath = word !== "";
  return (
    <tr class={`${status} ${isChosen ? "chosen" : ""}`}>
      <th scope="row">{NAMES[planner]}</th>
      <td>{hasPath ? formatClock(time_to_converge_s) : "none"}</td>
      <td>
        {hasPath
          ? `${over_exact_s < 0 ? "\u2212" : "+"}${Math.abs(over_exact_s).toFixed(1)} s`
          : ""}
      </td>
      <td>{word}</td>
      <td>{status === "preparing" ? "" : compute_ms.toFixed(1)}</td>
      <td title={meaning}>
        <span aria-hidden="true">{sign}</span>
        <span class="visually-hidden">{meaning}</span>
      </td>
    </tr>
  );
}
