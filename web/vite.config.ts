import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { defineConfig } from "vitest/config";
import manifest from "./package.json" with { type: "json" };

/** The WebSocket sub-protocol: page and server speak only if they were built from the same types. */
function protocol(): string {
  const wire = readFileSync(new URL("./src/wire.ts", import.meta.url));
  return `relguide-${createHash("sha256").update(wire).digest("hex").slice(0, 12)}`;
}

const server = "http://127.0.0.1:8000";

export default defineConfig({
  define: {
    __PROTOCOL__: JSON.stringify(protocol()),
    __VERSION__: JSON.stringify(manifest.version),
  },
  build: { target: "es2023", sourcemap: false, modulePreload: { polyfill: false } },
  server: {
    proxy: {
      "/api": { target: server, ws: true },
      "/scene": { target: server, ws: true },
      "/docs": server,
      "/openapi.json": server,
    },
  },
  test: { environment: "happy-dom", include: ["test/**/*.test.{ts,tsx}"] },
});
