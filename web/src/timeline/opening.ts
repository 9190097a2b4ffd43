/** Opens what is to be replayed: a flight on record of the service, or a file. */

import type { Document } from "../wire";
import { MOST_BYTES, type Read } from "./recording";

/** The documents of a file, read beside the page. */
export function readFile(file: Blob): Promise<Read> {
  if (file.size > MOST_BYTES) {
    const size = Math.round(file.size / 1024 / 1024);
    const most = MOST_BYTES / 1024 / 1024;
    return Promise.resolve({
      kind: "refused",
      sentence: `This file has ${size} MB, and the page reads ${most}: record fewer samples.`,
    });
  }
  return new Promise((resolve) => {
    const worker = new Worker(new URL("./reading.worker.ts", import.meta.url), { type: "module" });
    const answer = (read: Read) => {
      worker.terminate();
      resolve(read);
    };
    worker.onmessage = ({ data }: MessageEvent<Read>) => answer(data);
    worker.onerror = ({ message }) =>
      answer({ kind: "refused", sentence: `The file could not be read: ${message}.` });
    worker.postMessage(file);
  });
}

/** How a recording is called: its title, as it says itself. */
export function titleOf(documents: readonly Document[]): string {
  const [started] = documents;
  return started?.kind === "flight_started" ? started.title : "Recording";
}
