/** Under the map: why a link was not laid out, what can be done and, on a small page, what flies it. */

import type { Actions, Session } from "../session";
import { HowTo } from "./how-to";
import { twoTimes } from "./two-times";

export function UnderMap(props: {
  session: Session;
  actions: Actions;
  /** Whether the panels beside the map are far below it. */
  isSmall: boolean;
}) {
  const { session, actions, isSmall } = props;
  return (
    <>
      <Notice session={session} />
      {isSmall && <FlyBar session={session} actions={actions} />}
      <HowTo />
    </>
  );
}

function Notice({ session: { map } }: { session: Session }) {
  if (map.notice.value === "") return null;
  return (
    <p class="map-notice" role="alert">
      {map.notice.value}
    </p>
  );
}

function FlyBar({ session, actions }: { session: Session; actions: Actions }) {
  const { reading, isLate } = session.map;
  const { toJoin, trouble } = reading.shown.numbers.value;
  const { label, note, remark } = twoTimes(reading.answered.value);
  return (
    <section class={`fly-bar ${isLate.value ? "is-late" : ""}`} aria-label="Times, and fly it">
      {trouble === null ? (
        <p class="fly-times">
          <b>{toJoin}</b>{" "}
          {[label?.toLowerCase(), note].filter((part) => part !== undefined).join("; ")}
        </p>
      ) : (
        <p class="fly-times caution">{trouble.sentence}</p>
      )}
      <button type="button" class="primary" onClick={() => actions.fly()}>
        Fly it
      </button>
      {trouble === null && remark !== undefined && <p class="why">{remark}</p>}
    </section>
  );
}
