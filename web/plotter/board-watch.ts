/** Plans again when the current plotter's board moves differently, because a plan depends on the firmware. */
import { findMachine, isPlannedAlike } from "../../src/internal.js";
import { boardFirmware, type PageStore } from "../state/store.js";

/** Returns a function that stops this. */
export const replanForBoard = (store: PageStore, replan: () => void): (() => void) =>
  store.subscribe((state, before) => {
    if (state.plotters === before.plotters && state.plotterId === before.plotterId) return;
    const machine = findMachine(state.settings);
    const { pen } = state.settings;
    if (machine && !isPlannedAlike(machine, pen, boardFirmware(state), boardFirmware(before))) replan();
  });
