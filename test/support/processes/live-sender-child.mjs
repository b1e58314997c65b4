/** Sends a line to a server as a live drawing that is never ended: arguments are the WebSocket's address and the points. */
import { WebSocket } from "ws";

const [, , address, line] = process.argv;
const socket = new WebSocket(address, "plotwright-live");
socket.on("open", () => socket.send('{"begin":{}}'));
socket.once("message", () => socket.send(JSON.stringify({ lineTo: JSON.parse(line) })));
setInterval(() => undefined, 1_000);
