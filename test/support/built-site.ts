/** Runs before tests of the web site and of the page without a server: builds both if the sources have changed. */
import { ensureTestSite } from "../../scripts/setup.mjs";

export default function setup(): void {
  ensureTestSite();
}
