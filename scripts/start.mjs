/** `npm start [-- options]`: install, build, serve. Options after -- go to `plotwright serve`. */
import { spawn } from "node:child_process";
import { ROOT, checkNode, ensureBuild, ensureDependencies } from "./setup.mjs";

checkNode();
ensureDependencies();
ensureBuild();

// The channel tells the server when this process is gone, however it ended: it lifts the pen then, and ends too.
const server = spawn(process.execPath, ["dist/server/main.js", ...process.argv.slice(2)], {
  cwd: ROOT,
  stdio: ["inherit", "inherit", "inherit", "ipc"],
});
const end = () => server.connected && server.disconnect();
for (const signal of ["SIGINT", "SIGTERM", "SIGHUP"]) process.on(signal, end);
server.on("exit", (code) => process.exit(code ?? 1));

// npm ends its shell, not this process: then the parent changes. (On SIGKILL of npm, its shell lives on unnoticed.)
const npm = process.ppid;
if (process.env.npm_lifecycle_event === "start") {
  setInterval(() => process.ppid !== npm && end(), 500).unref();
}
