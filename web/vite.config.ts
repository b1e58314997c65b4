import react from "@vitejs/plugin-react";
import { defineConfig } from "vite";

// The page is served by plotwright's own server under a strict content security policy:
// everything is a file of its own, nothing is inlined into the HTML.
export default defineConfig({
  // Relative to the package, where npm runs its scripts.
  root: "web",
  plugins: [react()],
  build: {
    outDir: "../dist/web",
    emptyOutDir: true,
    target: "es2022",
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
  },
  worker: { format: "es" },
  server: {
    port: 5173,
    // Only the versioned interface: /api/ is also where the sources of the client lie.
    proxy: { "^/api/v1/": { target: "http://127.0.0.1:9080" } },
  },
});
