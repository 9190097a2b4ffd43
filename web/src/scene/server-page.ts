/** The page of the server's own picture, in its frame: undressed of its chrome, listened to, and pressed. */

import type { Signal } from "@preact/signals";
import type { Camera, ViewName } from "./camera";

/** What it shows besides the picture: it has a place in our page, or none. */
const CHROME = "[class*=Notification], [class*=Paper-root] { display: none !important }";
/** Its sky is dark: brighter than this is the vendor's empty page (0 to 255). */
const DARK = 160;
/** Where the picture is looked at, as parts of its sides. */
const PARTS = [0.1, 0.5, 0.9] as const;

/** Takes the chrome off the scene's page, which is our own server's. Whether it has a canvas. */
export function dress(page: Document | null): page is Document {
  if (page === null || canvasOf(page) === null) return false;
  if (page.querySelector("style[data-dress]") !== null) return true;
  const style = page.createElement("style");
  style.dataset.dress = "";
  style.textContent = CHROME;
  page.body.append(style);
  return true;
}

/** Takes the camera of each picture, and notes when a hand moves it. */
export function listen(
  page: Document,
  camera: Signal<Camera | null>,
  view: Signal<ViewName>,
): void {
  const window: (Window & { onpicture?: unknown }) | null = page.defaultView;
  if (window === null || window.onpicture !== undefined) return;
  window.onpicture = (projection: readonly number[], seen: readonly number[]) => {
    camera.value = { projection: [...projection], view: [...seen] };
  };
  const free = () => {
    if (view.value === "Free") return;
    view.value = "Free";
    press(page, "Free");
  };
  page.addEventListener("wheel", free, { passive: true });
  page.addEventListener("pointermove", ({ buttons }) => {
    if (buttons !== 0) free();
  });
}

function canvasOf(page: Document): HTMLCanvasElement | null {
  return [...page.querySelectorAll("canvas")].find(({ width }) => width > 1) ?? null;
}

/** Whether the scene's own ground is drawn, and no longer the empty page. */
export function isDark(page: Document): boolean {
  const canvas = canvasOf(page);
  const glass = document.createElement("canvas");
  [glass.width, glass.height] = [PARTS.length, PARTS.length];
  const pen = glass.getContext("2d", { willReadFrequently: true });
  if (canvas === null || pen === null || isFading(canvas)) return false;
  for (const [i, x] of PARTS.entries())
    for (const [j, y] of PARTS.entries())
      pen.drawImage(canvas, x * canvas.width, y * canvas.height, 1, 1, i, j, 1, 1);
  const { data } = pen.getImageData(0, 0, PARTS.length, PARTS.length);
  let dark = 0;
  for (let at = 0; at < data.length; at += 4) {
    const [red = 0, green = 0, blue = 0, there = 0] = data.slice(at, at + 4);
    if (there > 200 && Math.max(red, green, blue) < DARK) dark += 1;
  }
  return dark > 5; // of nine: lines and labels may be bright
}

/** The vendor's page fades its canvas in: until then the poster is what can be seen. */
function isFading(canvas: HTMLCanvasElement): boolean {
  const style = canvas.ownerDocument.defaultView?.getComputedStyle(canvas);
  return Number(style?.opacity ?? 1) < 0.9;
}

/** Presses the scene's own button of a view. */
export function press(page: Document | null, view: ViewName): void {
  const buttons = [...(page?.querySelectorAll("button") ?? [])];
  buttons.find((button) => button.textContent === view)?.click();
}
