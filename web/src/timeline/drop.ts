/** A recording that is dragged onto the page is shown. */

import type { Actions } from "../session";

export function takeDroppedFiles({ openFile }: Pick<Actions, "openFile">): void {
  addEventListener("dragover", (event) => {
    if (event.dataTransfer?.types.includes("Files") === true) event.preventDefault();
  });
  addEventListener("drop", (event) => {
    const file = event.dataTransfer?.files[0];
    if (file === undefined) return;
    event.preventDefault();
    openFile(file);
  });
}
