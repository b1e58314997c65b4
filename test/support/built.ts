/** Runs before tests of the built product: builds dist/ if the sources have changed. */
import { ensureBuild } from "../../scripts/setup.mjs";

export default function setup(): void {
  ensureBuild();
}
