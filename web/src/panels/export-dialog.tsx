/** The dialog of what can be taken away of the flight that is shown. */

import { useSignal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { readRecorded } from "../api";
import { set, useFocus } from "../parts";
import type { Session } from "../session";
import "./dialogs.css";
import { Export } from "./export";

export function ExportDialog({ session }: { session: Session }) {
  const { exportOpen, flight, recording, status, shown, ndMode, ndAuto, ndRange } = session;
  const dialog = useFocus();
  const startedAt = useSignal<string | null>(null);
  const id = flight.id.value ?? "";
  const isRecorded =
    recording.value === null ? status.value?.recorded === true : recording.value.from === "record";
  useEffect(() => {
    startedAt.value = null;
    if (id === "" || !isRecorded) return;
    void readRecorded(id).then((answer) => {
      if (answer.kind === "done") startedAt.value = answer.value.started_at;
    });
  }, [id, isRecorded, startedAt]);
  return (
    <div
      class="help export-dialog"
      role="dialog"
      aria-labelledby="export-title"
      tabIndex={-1}
      ref={dialog}
    >
      <h2 id="export-title">Take it away</h2>
      <Export
        shown={shown}
        mode={ndMode.value === "ROSE" ? "ROSE" : "ARC"}
        range={ndAuto.value ? "auto" : ndRange.value}
        name={id}
        recordId={startedAt.value === null ? null : id}
        startedAt={startedAt.value ?? ""}
      />
      <button type="button" onClick={set(exportOpen, false)}>
        Close
      </button>
    </div>
  );
}
