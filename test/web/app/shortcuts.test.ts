/** Which keys run a shortcut, by what has the focus and what the page shows. */
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { DEFAULT_PLOT_SETTINGS, type Job } from "../../../src/schema/index.js";
import { PAGE_ACTIONS, SEARCH } from "../../../web/app/page-actions.js";
import { ACTIONS_WITH_KEYS, listenForShortcuts } from "../../../web/app/shortcuts.js";
import { isPressed, whyOff, type Page } from "../../../web/state/page-action.js";
import { createUiActions } from "../../../web/state/ui-actions.js";
import { DEFAULT_VIEW } from "../../../web/state/persist.js";
import { createPageStore, type PageState } from "../../../web/state/store.js";
import type { Planned } from "../../../web/worker/protocol.js";
import { makeJob, makePlotter } from "../../support/jobs/jobs-on-page.js";

/** The parts of the browser's elements that the page reads. */
class FakeElement {
  readonly isContentEditable: boolean = false;
  constructor(readonly tagName: string) {}
}
class FakeInput extends FakeElement {
  constructor(readonly type: string) {
    super("INPUT");
  }
}
class FakeEditable extends FakeElement {
  override readonly isContentEditable = true;
}

const BODY = new FakeElement("BODY");
const DRAWING = { key: "drawing-1", name: "waves", text: "<svg/>", sheet: null, jobId: null, sourceId: null };
const planned = (strokeCount: number, x1: number): Planned =>
  ({ strokeCount, drawnBox: { x0: 0, y0: 0, x1, y1: 10 } }) as Planned;

const STEP = { settings: DEFAULT_PLOT_SETTINGS, presets: [], drawing: DRAWING, selectedPieces: [] };

let listener: (event: KeyboardEvent) => void;

beforeEach(() => {
  vi.stubGlobal("HTMLElement", FakeElement);
  vi.stubGlobal("HTMLInputElement", FakeInput);
  vi.stubGlobal("document", {
    addEventListener: (_type: string, listen: typeof listener) => (listener = listen),
  });
});
afterEach(() => vi.unstubAllGlobals());

const makePage = () => {
  const store = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW });
  store.setState({
    link: "connected",
    plotters: [makePlotter("virtual")],
    drawing: DRAWING,
    planned: planned(1, 10),
    undoStack: [STEP, STEP],
    redoStack: [STEP],
  });
  const done = {
    undo: vi.fn(),
    redo: vi.fn(),
    queueDrawing: vi.fn(() => Promise.resolve()),
    actOnJob: vi.fn(() => Promise.resolve(null)),
    togglePlaying: vi.fn(),
  };
  const actions = { ...createUiActions(store, () => undefined), ...done };
  listenForShortcuts({ store, actions, backend: { features: {} } } as unknown as Page);
  /** True: the browser does nothing of its own with the key. */
  const press = (key: string, more: Partial<KeyboardEvent> = {}, target = BODY): boolean => {
    const preventDefault = vi.fn();
    const event = { key, target, ctrlKey: false, metaKey: false, shiftKey: false, altKey: false };
    listener({ ...event, preventDefault, ...more } as unknown as KeyboardEvent);
    return preventDefault.mock.calls.length > 0;
  };
  return { store, done, press };
};

describe("a key that is held", () => {
  it("adds one job", () => {
    const { done, press } = makePage();
    press("q");
    press("q", { repeat: true });
    expect(done.queueDrawing).toHaveBeenCalledTimes(1);
  });

  it("pauses the plot and does not resume it", () => {
    const { store, done, press } = makePage();
    store.setState({ jobs: [makeJob("a", { state: "plotting" })] });
    press("p");
    store.setState({ jobs: [makeJob("a", { state: "paused" })] });
    press("p", { repeat: true });
    expect(done.actOnJob.mock.calls).toEqual([["a", "pause"]]);
  });

  it("undoes and redoes step by step", () => {
    const { done, press } = makePage();
    press("z", { ctrlKey: true });
    press("z", { ctrlKey: true, repeat: true });
    press("z", { ctrlKey: true, shiftKey: true, repeat: true });
    expect(done.undo).toHaveBeenCalledTimes(2);
    expect(done.redo).toHaveBeenCalledTimes(1);
  });

  it("does not scroll the page if it is Space", () => {
    const { done, press } = makePage();
    expect(press(" ", { repeat: true })).toBe(true);
    expect(done.togglePlaying).not.toHaveBeenCalled();
  });
});

describe("Q, like the button", () => {
  const OFF: Readonly<Record<string, Partial<PageState>>> = {
    "while a drawing is being added": { busyAction: "add" },
    "while a plot is being started": { busyAction: "plot" },
    "while a job is being saved": { busyAction: "save" },
    "without a drawing": { drawing: null },
    "before the plan": { planned: null },
    "without lines": { planned: planned(0, 10) },
    "after a fault": { fault: { message: "torn", stage: "import" } },
    "without a connection": { link: "lost" },
    "without a plotter": { plotters: [] },
    "for a watcher": { me: { role: "watch", id: null, name: null } },
    "out of reach": { planned: planned(1, 5_000) },
  };

  it.each(Object.entries(OFF))("does nothing %s", (_when, state) => {
    const { store, done, press } = makePage();
    store.setState(state);
    press("q");
    expect(done.queueDrawing).not.toHaveBeenCalled();
  });

  it("adds the drawing while another request runs", () => {
    const { store, done, press } = makePage();
    store.setState({ busyAction: "samples" });
    press("q");
    expect(done.queueDrawing).toHaveBeenCalledTimes(1);
  });
});

describe("P, like the job's main button", () => {
  const WATCHER: Partial<PageState> = { me: { role: "watch", id: null, name: null } };
  const cases: readonly (readonly [string, Partial<Job>, Partial<PageState>, readonly string[]])[] = [
    ["pauses a plot", { state: "plotting" }, {}, ["pause"]],
    ["resumes a paused plot", { state: "paused" }, {}, ["resume"]],
    ["pauses a plot for a watcher", { state: "plotting" }, WATCHER, ["pause"]],
    ["does not resume it for a watcher", { state: "paused" }, WATCHER, []],
    ["does nothing without a connection", { state: "plotting" }, { link: "lost" }, []],
    ["does nothing while its request runs", { state: "plotting" }, { busyAction: "pause a" }, []],
    ["does nothing for an interrupted plot, which needs a look first", { state: "interrupted" }, {}, []],
  ];

  it.each(cases)("%s", (_what, job, state, expected) => {
    const { store, done, press } = makePage();
    store.setState({ ...state, jobs: [makeJob("a", job)] });
    press("p");
    expect(done.actOnJob.mock.calls).toEqual(expected.map((action) => ["a", action]));
  });
});

describe("the control that has the focus", () => {
  const pressed = [
    ...["checkbox", "radio", "range", "color", "file"].map((type) => new FakeInput(type)),
    ...["BUTTON", "SUMMARY"].map((name) => new FakeElement(name)),
  ];
  const typed = [
    ...["text", "url"].map((type) => new FakeInput(type)),
    ...["TEXTAREA", "SELECT"].map((name) => new FakeElement(name)),
    new FakeEditable("DIV"),
  ];

  it.each(pressed)("handles only Space if it is pressed: %o", (target) => {
    const { done, press } = makePage();
    expect(press("z", { ctrlKey: true }, target)).toBe(true);
    expect(done.undo).toHaveBeenCalledTimes(1);
    expect(press(" ", {}, target)).toBe(false);
    expect(done.togglePlaying).not.toHaveBeenCalled();
  });

  it.each(typed)("handles every key if it takes text or lists choices: %o", (target) => {
    const { done, press } = makePage();
    expect(press("z", { ctrlKey: true }, target)).toBe(false);
    expect(press("q", {}, target)).toBe(false);
    expect(done.undo).not.toHaveBeenCalled();
    expect(done.queueDrawing).not.toHaveBeenCalled();
  });
});

describe("under a dialog", () => {
  const button = new FakeElement("BUTTON");

  it.each<[string, Partial<PageState>]>([
    ["a dialog", { openDialog: "machines" }],
    ["the question", { takeOverQuestion: { operator: null, answer: () => undefined } }],
  ])("the drawing stays as it is: %s", (_what, state) => {
    const { store, done, press } = makePage();
    store.setState(state);
    press("z", { ctrlKey: true }, button);
    press("q", {}, button);
    expect(done.undo).not.toHaveBeenCalled();
    expect(done.queueDrawing).not.toHaveBeenCalled();
  });

  it("? opens and closes the help, and leaves another dialog open", () => {
    const { store, press } = makePage();
    press("?", {}, button);
    expect(store.getState().openDialog).toBe("keys");
    press("?", {}, button);
    expect(store.getState().openDialog).toBeNull();
    store.setState({ openDialog: "machines" });
    press("?", {}, button);
    expect(store.getState().openDialog).toBe("machines");
  });
});

describe("Ctrl K", () => {
  const text = new FakeInput("text");

  it("opens the search also while the user types, and closes it", () => {
    const { store, press } = makePage();
    expect(press("k", { ctrlKey: true }, text)).toBe(true);
    expect(store.getState().openDialog).toBe("search");
    press("k", { metaKey: true }, text);
    expect(store.getState().openDialog).toBeNull();
  });

  it("leaves another dialog and the question open", () => {
    const { store, press } = makePage();
    store.setState({ openDialog: "console" });
    press("k", { ctrlKey: true }, text);
    expect(store.getState().openDialog).toBe("console");
    store.setState({ openDialog: null, takeOverQuestion: { operator: null, answer: () => undefined } });
    press("k", { ctrlKey: true }, text);
    expect(store.getState().openDialog).toBeNull();
  });
});

describe("the actions of the page", () => {
  it("have names and keys of their own", () => {
    const ids = PAGE_ACTIONS.map(({ id }) => id);
    expect(new Set(ids).size).toBe(ids.length);
    const keys = ACTIONS_WITH_KEYS.map(({ key }) => key);
    expect(new Set(keys).size).toBe(keys.length);
    expect(keys).toEqual(
      expect.arrayContaining(["P", "Q", "?", "T", "G", "Space", "Ctrl Z", "Ctrl Shift Z"]),
    );
    expect(ACTIONS_WITH_KEYS).toContain(SEARCH);
  });

  it.each(ACTIONS_WITH_KEYS)("are performed by their own key only: $id", (action) => {
    const held = (action.key ?? "").split(" ");
    const last = held.pop() ?? "";
    const event = {
      key: last === "Space" ? " " : last.toLowerCase(),
      ctrlKey: held.includes("Ctrl"),
      shiftKey: held.includes("Shift") || last === "?",
      metaKey: false,
      altKey: false,
    };
    expect(ACTIONS_WITH_KEYS.filter((other) => isPressed(other, event))).toEqual([action]);
    expect(isPressed(action, { ...event, key: "j" })).toBe(false);
  });

  it("removes a drawing with Backspace too, which stands for Delete on many keyboards", () => {
    const event = { key: "Backspace", ctrlKey: false, shiftKey: false, metaKey: false, altKey: false };
    expect(ACTIONS_WITH_KEYS.filter((one) => isPressed(one, event)).map(({ id }) => id)).toEqual([
      "remove-piece",
    ]);
  });

  it("say why they are off before the server has answered and without a drawing", () => {
    const state = createPageStore({ settings: DEFAULT_PLOT_SETTINGS, view: DEFAULT_VIEW }).getState();
    const reasons = PAGE_ACTIONS.map((action) => [action.id, whyOff(action, state)]);
    const off = reasons.filter(([, why]) => why !== null);
    expect(off.map(([id]) => id)).toEqual(
      expect.arrayContaining(["plot", "queue", "undo", "redo", "home", "play", "frame"]),
    );
    for (const [, why] of off) expect(why).toMatch(/^[A-Z].*[.…]$/);
  });
});
