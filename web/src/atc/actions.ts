/** What the page does besides answering: follow the stream, save and open recordings, the demonstration. */

import { batch } from "@preact/signals";
import { saveFile } from "../save";
import { confirm } from "./answering";
import { startDemo } from "./demo";
import { keepInSight, showAll } from "./map/view";
import { MOST_BYTES, readRecording, writeRecording } from "./recording";
import { choose, openTab, type Station } from "./station";
import { openStream, type Stream } from "./stream";

export interface Actions {
  /** Follows the stream from now on, in place of a file. */
  follow(): void;
  save(): void;
  openFile(file: File): Promise<void>;
  demo(): void;
}

/** Of a demonstration that was begun beside a recording. */
const ELSEWHERE = "Five flights ask. Load this page again to leave the recording and see them.";

export function createActions(station: Station, address: string, protocol: string): Actions {
  const { store, view, link, notice, file, busy } = station;
  let stream: Stream | null = null;
  const begin = () => {
    stream?.close();
    stream = null;
    view.isHeld.value = false;
    batch(() => {
      store.clear();
      choose(station, null);
      notice.value = "";
    });
  };

  const follow = () => {
    begin();
    file.value = "";
    stream = openStream(address, protocol, {
      link: (state) => {
        link.value = state;
      },
      refused: (sentence) => {
        notice.value = sentence;
      },
      received: ({ snapshot, documents }) => {
        batch(() => {
          if (snapshot) store.renew(documents);
          else store.receive(documents);
          confirm(station);
        });
        keepInSight(view, store.sky.value.aircraft);
      },
    });
  };

  return {
    follow,
    save() {
      const text = writeRecording(store.documents());
      const day = new Date().toISOString().slice(0, 19).replaceAll(":", "");
      saveFile(`atc-${day}.jsonl`, new Blob([text], { type: "application/jsonl" }));
    },
    async openFile(found) {
      if (found.size > MOST_BYTES) {
        notice.value = `${found.name} has more than ${MOST_BYTES / 1024 / 1024} MB: it is not read.`;
        return;
      }
      const read = readRecording(await found.text());
      if (read.kind === "refused") {
        notice.value = read.sentence;
        return;
      }
      begin();
      batch(() => {
        link.value = "closed";
        file.value = found.name;
        store.receive(read.documents);
      });
      showAll(view, store.sky.value.aircraft);
    },
    demo() {
      busy.value = "Starting five flights …";
      void startDemo((sentence) => {
        busy.value = sentence;
      }).then((sentence) => {
        busy.value = "";
        notice.value = sentence || (file.value === "" ? "" : ELSEWHERE);
        if (notice.value === "") openTab(station, "");
      });
    },
  };
}
