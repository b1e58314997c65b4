/** Runs before tests of the built product: builds it, and the web site with the page without a server, if sources changed. */
import { ensureBuild, ensureTestSite } from "../../../scripts/setup.mjs";

export default function setup(): void {
  ensureBuild();
  ensureTestSite();
}
