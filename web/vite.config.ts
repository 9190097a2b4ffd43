/// <reference types="vitest/config" />
import { defineConfig, type UserConfig } from "vite";
import manifest from "./package.json" with { type: "json" };

const server = "http://127.0.0.1:8000";

const common = {
  base: "./", // a proxy may serve it below a path of its own
  define: { __VERSION__: JSON.stringify(manifest.version) },
} satisfies UserConfig;

/** A bundle in one file, beside the page that is already in `dist`. */
function bundle(entry: string, fileName: string): UserConfig {
  return {
    ...common,
    // a library's dependencies ask in which of their builds they run
    define: { ...common.define, "process.env.NODE_ENV": JSON.stringify("production") },
    publicDir: false,
    build: {
      target: "es2022",
      outDir: "dist/embed",
      emptyOutDir: false,
      minify: true,
      lib: { entry, name: "relguide", formats: ["iife"], fileName: () => fileName },
    },
  };
}

const page: UserConfig = {
  ...common,
  build: {
    target: "es2023",
    sourcemap: false,
    modulePreload: { polyfill: false },
    rolldownOptions: { input: ["index.html", "atc.html"] },
  },
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
};

/** What lies beside the page, by mode. */
const bundles: Readonly<Record<string, UserConfig>> = {
  picture: bundle("src/picture/picture.tsx", "picture.js"),
  element: bundle("src/embed/relguide-nd.tsx", "relguide-nd.js"),
};

/**
 * `vite build` makes the page; `--mode picture` what draws without a browser, `--mode element` the
 * element `<relguide-nd>`.
 */
export default defineConfig(({ mode }) => bundles[mode] ?? page);
