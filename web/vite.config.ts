/// <reference types="vitest/config" />
import { resolve } from "node:path";
import { defineConfig, type Rolldown, type UserConfig } from "vite";
import manifest from "./package.json" with { type: "json" };

const COCKPIT = "src/main.tsx";
const CONTROLLER = "src/atc/main.tsx";

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

/** A chunk of all modules that each of some pages loads at once: one file compresses better than many. */
function atOnce(name: string, ...pages: string[]): Rolldown.CodeSplittingGroup {
  return {
    debugName: name,
    name(id, graph) {
      const isAtOnce = (page: string) => {
        const found = new Set([resolve(import.meta.dirname, page)]);
        for (const each of found)
          for (const next of graph.getModuleInfo(each)?.importedIds ?? []) found.add(next);
        return found.has(id);
      };
      return pages.every(isAtOnce) ? name : null;
    },
  };
}

const page: UserConfig = {
  ...common,
  build: {
    target: "es2023",
    sourcemap: false,
    modulePreload: { polyfill: false },
    rolldownOptions: {
      input: ["index.html", "atc.html"],
      output: {
        codeSplitting: {
          groups: [atOnce("pages", COCKPIT, CONTROLLER), atOnce("cockpit", COCKPIT)],
        },
      },
    },
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
