import { readFileSync } from "node:fs";
import { defineConfig } from "vite";

/** The page holds three.js, whose licence asks to be where it is; minifying would take it out. */
function licences() {
  return {
    name: "licences",
    enforce: "post",
    generateBundle(_, bundle) {
      const licence = readFileSync(new URL("node_modules/three/LICENSE", import.meta.url), "utf8").trim();
      for (const part of Object.values(bundle)) {
        if (part.type !== "chunk") continue;
        part.code = `/*! Brisance's viewer, Apache License 2.0. It holds three.js:\n\n${licence}\n*/\n${part.code}`;
      }
    },
  };
}

// One script and one style sheet under fixed names: the Python package serves them, and the exported page holds them.
export default defineConfig({
  base: "./",
  plugins: [licences()],
  build: {
    outDir: "../python/brisance/view/static",
    emptyOutDir: true,
    modulePreload: false,
    chunkSizeWarningLimit: 1500,
    rollupOptions: {
      output: {
        entryFileNames: "viewer.js",
        assetFileNames: "viewer[extname]",
      },
    },
  },
});
