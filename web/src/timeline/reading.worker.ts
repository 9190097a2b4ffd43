/** Reads a recording beside the page, which stays quick meanwhile. */

import { MOST_BYTES, parseRecording, type Read } from "./recording";

addEventListener("message", (event: MessageEvent<Blob>) => {
  void read(event.data).then((answer) => postMessage(answer));
});

async function read(file: Blob): Promise<Read> {
  const head = new Uint8Array(await file.slice(0, 2).arrayBuffer());
  const isPacked = head[0] === 0x1f && head[1] === 0x8b;
  const plain = isPacked
    ? file.stream().pipeThrough(new DecompressionStream("gzip"))
    : file.stream();
  const decoder = new TextDecoder();
  const parts: string[] = [];
  let size = 0;
  const reader = plain.getReader();
  try {
    for (let next = await reader.read(); !next.done; next = await reader.read()) {
      size += next.value.byteLength;
      if (size > MOST_BYTES) return tooLarge();
      parts.push(decoder.decode(next.value, { stream: true }));
    }
  } catch (error) {
    const why = error instanceof Error ? error.message : "it cannot be unpacked";
    return { kind: "refused", sentence: `This file is damaged: ${why.replace(/\.$/, "")}.` };
  }
  return parseRecording(parts.join(""));
}

function tooLarge(): Read {
  const most = MOST_BYTES / 1024 / 1024;
  return { kind: "refused", sentence: `This recording has over ${most} MB: record fewer samples.` };
}
