/** The stream of ticks: one WebSocket, opened again with growing patience when it breaks. */

import type { Link } from "./store/types";
import type { ControlAnswer, Tick, Upstream } from "./wire";

/** Close code of a server that speaks another version of the wire. */
export const OTHER_VERSION = 4400;
/** All its codes for closing for good begin here (no such flight, flight removed, flight broken). */
const FOR_GOOD = 4400;

/** First wait before trying again, and the longest [ms]. */
const FIRST_WAIT = 500;
const LONGEST_WAIT = 8000;

export interface StreamEvents {
  tick(tick: Tick): void;
  link(state: Link): void;
  /** The link broke; the next try is in `wait` [ms]. */
  broken(wait: number): void;
  /** The server closed for good: with OTHER_VERSION or because the flight is no more. */
  refused(code: number, sentence: string): void;
}

export interface Stream {
  /** Told who has control: set by what has asked for it. */
  answered: ((answer: ControlAnswer) => void) | null;
  /** Sends a frame; false while there is no link. */
  send(frame: Upstream): boolean;
  /** Tries again now instead of waiting. */
  retry(): void;
  /** Ends it: no event comes after. */
  close(): void;
}

/** Opens the stream at `url`, a path or an address, and keeps it open. */
export function openStream(url: string, protocol: string, events: StreamEvents): Stream {
  const address = socketAddress(url, location.href);
  let socket: WebSocket | null = null;
  let timer: ReturnType<typeof setTimeout> | null = null;
  let failures = 0;

  function open(): void {
    timer = null;
    events.link("connecting");
    const opened = new WebSocket(address, protocol);
    socket = opened;
    opened.onopen = () => events.link("open");
    opened.onmessage = (message: MessageEvent<string>) => {
      failures = 0; // only data prove the link: a server may accept and close at once
      const frame = JSON.parse(message.data) as Tick | ControlAnswer;
      if (frame.kind === "control") stream.answered?.(frame);
      else events.tick(frame);
    };
    opened.onclose = (closed) => {
      if (socket !== opened) return;
      socket = null;
      events.link("closed");
      if (closed.code >= FOR_GOOD) {
        events.refused(closed.code, closed.reason);
        return;
      }
      const wait = Math.min(LONGEST_WAIT, FIRST_WAIT * 2 ** failures);
      failures += 1;
      timer = setTimeout(open, wait);
      events.broken(wait);
    };
  }

  const stream: Stream = {
    answered: null,
    send(frame) {
      if (socket?.readyState !== WebSocket.OPEN) return false;
      socket.send(JSON.stringify(frame));
      return true;
    },
    retry() {
      if (timer === null) return;
      clearTimeout(timer);
      open();
    },
    close() {
      if (timer !== null) clearTimeout(timer);
      timer = null;
      const open = socket;
      socket = null;
      open?.close();
    },
  };
  open();
  return stream;
}

/** The ws: or wss: address of a path on the page's own server. */
export function socketAddress(path: string, page: string): string {
  const address = new URL(path, page);
  address.protocol = address.protocol.replace("http", "ws");
  return address.href;
}
