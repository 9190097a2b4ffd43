/** What stays within reach while the scene takes the place of the panels: time, crew, key numbers. */

import { EngageButtons } from "../panels/engage";
import { Choice, Icon } from "../parts";
import { type Actions, isFlying, RATES, type Session } from "../session";
import { STATE_NAMES } from "../store/reading";

export function SceneBar(props: { session: Session; actions: Actions }) {
  const { session, actions } = props;
  const { flight, shown } = session;
  const { rate, paused, ended } = flight.clock.value;
  const numbers = shown.numbers.value;
  return (
    <section class="scene-bar" aria-label="Flight and guidance">
      <button
        type="button"
        class="primary"
        disabled={ended || !isFlying(session)}
        onClick={() => (paused ? actions.play() : actions.pause())}
      >
        <Icon name={paused ? "play" : "pause"} />
        {paused ? "Play" : "Pause"}
      </button>
      <Choice
        label="Simulated seconds per second"
        options={RATES}
        chosen={RATES.find((offered) => offered === rate) ?? null}
        text={(offered) => `×${offered}`}
        choose={actions.setRate}
      />
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
