/** The controllers' stream: numbered frames, resumed after the last one when it breaks. */

import type { AtcFrame } from "../wire";

/** All codes for closing for good begin here. */
const FOR_GOOD = 4400;
/** First wait before trying again, and the longest [ms]. */
const FIRST_WAIT = 500;
const LONGEST_WAIT = 8000;

export type Link = "connecting" | "open" | "closed";

export interface StreamEvents {
  received(frame: AtcFrame): void;
  link(state: Link): void;
  /** The server closed for good, and says why. */
  refused(sentence: string): void;
}

export interface Stream {
  close(): void;
}

/** Opens the stream at an address and keeps it open. */
export function openStream(address: string, protocol: string, events: StreamEvents): Stream {
  let socket: WebSocket | null = null;
  let timer: ReturnType<typeof setTimeout> | null = null;
  let failures = 0;
  let last: number | null = null;

  function open(): void {
    timer = null;
    events.link("connecting");
    const opened = new WebSocket(last === null ? address : `${address}?from=${last + 1}`, protocol);
    socket = opened;
    opened.onopen = () => events.link("open");
    opened.onmessage = (message: MessageEvent<string>) => {
      failures = 0; // only data prove the link: a server may accept and close at once
      const frame = JSON.parse(message.data) as AtcFrame;
      last = frame.number;
      events.received(frame);
    };
    opened.onclose = (closed) => {
      if (socket !== opened) return;
      socket = null;
      events.link("closed");
      if (closed.code >= FOR_GOOD) {
        events.refused(closed.reason);
        return;
      }
      const wait = Math.min(LONGEST_WAIT, FIRST_WAIT * 2 ** failures);
      failures += 1;
      timer = setTimeout(open, wait);
    };
  }

  open();
  return {
    close() {
      if (timer !== null) clearTimeout(timer);
      const opened = socket;
      socket = null;
      opened?.close();
    },
  };
}
