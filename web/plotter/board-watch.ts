/** A plan is for one board's firmware: for another board that moves differently, plans again. */
import { findMachine, isPlannedAlike } from "../../src/internal.js";
import { boardFirmware, type PageStore } from "../state/store.js";

/** Watches the current plotter; returns a function that stops. */
export const replanForBoard = (store: PageStore, replan: () => void): (() => void) =>
  store.subscribe((state, before) => {
    if (state.plotters === before.plotters && state.plotterId === before.plotterId) return;
    const machine = findMachine(state.settings);
    if (machine && !isPlannedAlike(machine, boardFirmware(state), boardFirmware(before))) replan();
  });
