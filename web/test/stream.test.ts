import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import { OTHER_VERSION, openStream, socketAddress } from "../src/stream";
import { tick } from "./samples";

class FakeSocket {
  static opened: FakeSocket[] = [];
  onopen: (() => void) | null = null;
  onmessage: ((message: { data: string }) => void) | null = null;
  onclose: ((event: { code: number; reason: string }) => void) | null = null;
  close = vi.fn();
  constructor(
    readonly url: string,
    readonly protocol: string,
  ) {
    FakeSocket.opened.push(this);
  }
}

function events() {
  return { tick: vi.fn(), link: vi.fn(), broken: vi.fn(), refused: vi.fn() };
}

function newest(): FakeSocket {
  const socket = FakeSocket.opened.at(-1);
  if (socket === undefined) throw new Error("no socket was opened");
  return socket;
}

beforeEach(() => {
  FakeSocket.opened = [];
  vi.stubGlobal("WebSocket", FakeSocket);
  vi.useFakeTimers();
});

afterEach(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

describe("the stream", () => {
  test("hands over ticks and offers the protocol", () => {
    const heard = events();
    openStream("/api/v1/flights/one/stream", "relguide-0", heard);
    newest().onopen?.();
    newest().onmessage?.({ data: JSON.stringify(tick(1, [])) });
    expect(heard.tick).toHaveBeenCalledWith(tick(1, []));
    expect(newest().protocol).toBe("relguide-0");
    expect(heard.link.mock.calls).toEqual([["connecting"], ["open"]]);
  });

  test("opens again with growing patience until data come", () => {
    const heard = events();
    openStream("/s", "p", heard);
    const waits = [500, 1000, 2000, 4000, 8000, 8000];
    for (const wait of waits) {
      newest().onopen?.();
      newest().onclose?.({ code: 1006, reason: "" });
      vi.advanceTimersByTime(wait);
    }
    expect(heard.broken.mock.calls.flat()).toEqual(waits);
    expect(FakeSocket.opened).toHaveLength(waits.length + 1);
    newest().onmessage?.({ data: JSON.stringify(tick(1, [])) });
    newest().onclose?.({ code: 1006, reason: "" });
    expect(heard.broken).toHaveBeenLastCalledWith(500);
  });

  test("a retry does not wait", () => {
    const stream = openStream("/s", "p", events());
    stream.retry();
    expect(FakeSocket.opened).toHaveLength(1); // it is open: nothing to retry
    newest().onclose?.({ code: 1006, reason: "" });
    stream.retry();
    expect(FakeSocket.opened).toHaveLength(2);
    vi.advanceTimersByTime(60_000);
    expect(FakeSocket.opened).toHaveLength(2);
  });

  test("does not come back when the server closes for good", () => {
    const heard = events();
    openStream("/s", "p", heard);
    newest().onclose?.({ code: OTHER_VERSION, reason: "Reload." });
    vi.advanceTimersByTime(60_000);
    expect(heard.refused).toHaveBeenCalledWith(OTHER_VERSION, "Reload.");
    expect(FakeSocket.opened).toHaveLength(1);
  });

  test("says nothing once closed by the page", () => {
    const heard = events();
    const stream = openStream("/s", "p", heard);
    const socket = newest();
    stream.close();
    expect(socket.close).toHaveBeenCalled();
    socket.onclose?.({ code: 1005, reason: "" });
    vi.advanceTimersByTime(60_000);
    expect(heard.broken).not.toHaveBeenCalled();
  });

  test("dials the page's own server, secure as the page is", () => {
    expect(socketAddress("/a/b", "http://host:8000/?flight=x")).toBe("ws://host:8000/a/b");
    expect(socketAddress("/a/b", "https://host/")).toBe("wss://host/a/b");
  });
});
