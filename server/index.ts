/** Entry "plotwright/server": creates the whole server, for embedding in other programs. */
export { createServer, type PlotwrightServer, type ServerOptions } from "./composition/create-server.js";
