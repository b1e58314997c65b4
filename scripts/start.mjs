/** `npm start [-- options]`: install, build, serve. Options after -- go to `plotwright serve`. */
import { spawn } from "node:child_process";
import { ROOT, checkNode, ensureBuild, ensureDependencies } from "./setup.mjs";

checkNode();
ensureDependencies();
ensureBuild();

const server = spawn(process.execPath, ["dist/server/main.js", "serve", ...process.argv.slice(2)], {
  cwd: ROOT,
  stdio: "inherit",
});
// Ctrl-C in a terminal reaches the server by itself: sending it on would make it two. It decides how to end.
process.on("SIGINT", () => {
  if (!process.stdin.isTTY) server.kill("SIGINT");
});
process.on("SIGTERM", () => server.kill("SIGTERM"));
server.on("exit", (code) => process.exit(code ?? 1));
