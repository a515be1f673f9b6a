import { defineConfig } from "vite";

// One script and one style sheet under fixed names: the Python package serves them, and the exported page holds them.
export default defineConfig({
  base: "./",
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
