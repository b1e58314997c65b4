/** Before tests that run the built product: builds dist/ where the sources have changed since. */
import { ensureBuild } from "../../scripts/setup.mjs";

export default function setup(): void {
  ensureBuild();
}
