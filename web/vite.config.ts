/// <reference types="vitest/config" />
import { defineConfig } from "vite";
import manifest from "./package.json" with { type: "json" };

const server = "http://127.0.0.1:8000";

export default defineConfig({
  base: "./", // a proxy may serve it below a path of its own
  define: { __VERSION__: JSON.stringify(manifest.version) },
  build: { target: "es2023", sourcemap: false, modulePreload: { polyfill: false } },
  server: {
    proxy: {
      "/api": { target: server, ws: true },
      "/scene": { target: server, ws: true },
      "/docs": server,
      "/openapi.json": server,
    },
  },
  test: {
    environment: "happy-dom",
    include: ["test/**/*.test.{ts,tsx}"],
  },
});
