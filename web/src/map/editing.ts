/** What hands do to a situation: it is put on the map, changed, and shown as a flight at its first instant. */

import { batch, effect } from "@preact/signals";
import { type Editor, showAll } from "./editor";
import { type Situation, settle } from "./situation";
import { createThumbs } from "./thumbs";
import { keepStep } from "./undo";
import { showWhatIf } from "./what-if";

/** Shows what is laid out, from now on. */
export function openEditor(editor: Editor): Editor {
  const { flight, reading } = editor;
  editor.thumbs.value = createThumbs();
  effect(() => showWhatIf(flight, editor.situation.value, editor.answered.value));
  effect(() => {
    const { situation, answered } = reading.whole.value;
    showWhatIf(reading.flight, situation, answered);
  });
  return editor;
}

/** Puts another situation on the map and brings it into sight. */
export function putSituation(editor: Editor, situation: Situation): void {
  if (!editor.isBegun.peek()) openEditor(editor);
  batch(() => {
    if (editor.isBegun.value) keepStep(editor.steps, editor.situation.value, {});
    editor.situation.value = settle(situation);
    editor.answered.value = null;
    editor.isToFit.value = true;
    editor.notice.value = "";
    editor.isBegun.value = true;
  });
  showAll(editor);
}

/** Changes the situation; what the same hand does is one step, to be undone as one. */
export function edit(
  editor: Editor,
  change: (situation: Situation) => Situation,
  hand: unknown = {},
): void {
  const before = editor.situation.value;
  const after = settle(change(before));
  if (isSame(before, after)) return;
  batch(() => {
    keepStep(editor.steps, before, hand);
    editor.notice.value = "";
    editor.situation.value = after;
  });
}

export function isSame(one: Situation, other: Situation): boolean {
  return JSON.stringify(one) === JSON.stringify(other);
}
