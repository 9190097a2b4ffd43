/** Files that the page hands to its user. */

/** Lets the browser save a file. */
export function saveFile(name: string, content: Blob): void {
  const url = URL.createObjectURL(content);
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  // the browser has begun to read it by then [ms]
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** An SVG drawing in pixels, `zoom` for each of its units. */
export async function pngOf(svg: string, zoom = 2): Promise<Blob> {
  const image = new Image();
  // the page's own policy has images from its server and from data, not from blobs
  image.src = `data:image/svg+xml,${encodeURIComponent(svg)}`;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = zoom * image.naturalWidth;
  canvas.height = zoom * image.naturalHeight;
  canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => {
      if (blob === null) reject(new Error("The browser could not draw so large a picture."));
      else resolve(blob);
    }, "image/png"),
  );
}

/** A drawing with a font in it: drawn apart from the page, it has none of the page's. */
export async function withFont(svg: string, family: string, url: string): Promise<string> {
  const file = await (await fetch(url)).arrayBuffer();
  const bytes = Array.from(new Uint8Array(file), (byte) => String.fromCharCode(byte)).join("");
  const face = `@font-face{font-family:${family};src:url(data:font/woff2;base64,${btoa(bytes)})}`;
  return svg.replace("<defs>", `<defs><style>${face}</style>`);
}
