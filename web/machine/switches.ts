/** Home switches as the form shows them. */
import type { MachineProfile } from "../../src/index.js";

export type SwitchInput = NonNullable<MachineProfile["homing"]>["x"];

export const INPUT_PORTS_SHOWN: readonly SwitchInput["port"][] = ["A", "B", "C", "D", "E"];
