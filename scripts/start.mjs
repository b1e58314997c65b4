/** `npm start [-- options]`: install, build, serve. Options after -- go to `plotwright serve`. */
import { spawn } from "node:child_process";
import { ROOT, checkNode, ensureBuild, ensureDependencies, giveUp, optionsTakenByNpm } from "./setup.mjs";

const [taken] = optionsTakenByNpm(process.env);
if (taken !== undefined) {
  giveUp(
    `npm took ${taken} for itself. Put -- before the options of plotwright: npm start -- --port 9381`,
    2,
  );
}
checkNode();
ensureDependencies();
ensureBuild();

// If this process ends for any reason, the channel closes; the server then lifts the pen and ends too.
const server = spawn(process.execPath, ["dist/server/main.js", ...process.argv.slice(2)], {
  cwd: ROOT,
  stdio: ["inherit", "inherit", "inherit", "ipc"],
});
const end = () => server.connected && server.disconnect();
for (const signal of ["SIGINT", "SIGTERM", "SIGHUP"]) process.on(signal, end);
server.on("exit", (code) => process.exit(code ?? 1));

// npm ends its shell, but not this process. The process then has another parent. (If npm is killed by SIGKILL, its
// shell stays alive, and this can't be noticed.)
const npm = process.ppid;
if (process.env.npm_lifecycle_event === "start") {
  setInterval(() => process.ppid !== npm && end(), 500).unref();
}
