/** What stays within reach while the scene takes the place of the panels: the crew's steps and key numbers. */

import { EngageButtons } from "../panels/engage";
import type { Actions, Session } from "../session";
import { STATE_NAMES } from "../store/reading";

export function SceneBar(props: { session: Session; actions: Actions }) {
  const { session, actions } = props;
  const numbers = session.shown.numbers.value;
  return (
    <section class="scene-bar" aria-label="Relative guidance">
      <EngageButtons session={session} actions={actions} />
      <span class={`mode-name ${numbers.state}`}>{STATE_NAMES[numbers.state]}</span>
      <dl>
        <Key name="D" value={numbers.slotDistance} unit="NM" />
        <Key name="d" value={numbers.separation} unit="NM" />
        <Key name="MIN" value={numbers.minSeparation} unit="NM" />
        {numbers.toJoin !== "" && <Key name="CNV" value={numbers.toJoin} unit="" />}
        {numbers.timing !== null && <Key name="SLOT" value={numbers.timing.text} unit="" />}
      </dl>
    </section>
  );
}

function Key({ name, value, unit }: { name: string; value: string; unit: string }) {
  return (
    <div>
      <dt>{name}</dt>
      <dd>
        <span class="figure value">{value}</span>
        {unit !== "" && <span class="unit">{unit}</span>}
      </dd>
    </div>
  );
}
