/** What can be done with the situation: fly it, or take it along as a link, a request or a program. */

import { useSignal } from "@preact/signals";
import { Panel } from "../parts";
import type { Actions, Session } from "../session";
import { writeAddress } from "./link";
import { pythonOf } from "./python";
import { bodyOf } from "./situation";

const KINDS = ["Link", "REST", "Python"] as const;
type Kind = (typeof KINDS)[number];

export function TakeAlong({ session, actions }: { session: Session; actions: Actions }) {
  const { map, feedback, status } = session;
  const copied = useSignal<{ kind: Kind; text: string; isCopied: boolean } | null>(null);
  const copy = async (kind: Kind) => {
    const text = textOf(kind, session);
    copied.value = { kind, text, isCopied: await toClipboard(text) };
  };
  return (
    <Panel name="take" title="Take it along">
      <div class="row">
        <button type="button" class="primary grow" onClick={() => actions.fly()}>
          Fly it
        </button>
        <button
          type="button"
          class="grow"
          disabled={status.value === null}
          onClick={() => actions.mapFromFlight()}
        >
          From the flight
        </button>
      </div>
      <div class="row labelled">
        <span>Copy as</span>
        {KINDS.map((kind) => (
          <button type="button" class="grow" key={kind} onClick={() => void copy(kind)}>
            {kind}
          </button>
        ))}
      </div>
      <p class="feedback" role="status">
        {map.refusal.value !== "" ? (
          <>
            <b class="refused">REFUSED</b> {map.refusal.value}
          </>
        ) : copied.value?.isCopied === true ? (
          `${copied.value.kind} copied.`
        ) : copied.value !== null ? (
          "This browser does not let pages copy: take it from here."
        ) : feedback.value.kind === "refused" || feedback.value.kind === "sending" ? (
          feedback.value.text
        ) : (
          ""
        )}
      </p>
      {copied.value !== null && !copied.value.isCopied && (
        <textarea readOnly rows={5} aria-label={copied.value.kind} value={copied.value.text} />
      )}
    </Panel>
  );
}

export function textOf(kind: Kind, { map }: Pick<Session, "map">): string {
  const situation = map.situation.value;
  switch (kind) {
    case "Link": {
      const address = new URL("/?plan", location.href);
      writeAddress(address, situation);
      return address.href;
    }
    case "REST":
      return JSON.stringify(bodyOf(situation), null, 2);
    case "Python":
      return pythonOf(situation);
  }
}

/** Whether it worked: browsers allow it on pages that came by a safe way, to a click. */
async function toClipboard(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
