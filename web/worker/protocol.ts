/** What the page and its planning worker say to each other. Arrays are transferred, never copied. */
import type { Trajectory } from "../../src/index.js";
import type {
  Box,
  DrawingWarning,
  PaperSize,
  PenStop,
  Placement,
  PreparedLayer,
  StrokeLayer,
  TrajectoryStats,
} from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { FrameMm } from "../scene/placing.js";
import type { Picture } from "../scene/renderer.js";
import type { Scene } from "../scene/scene.js";
import type { CutOffPicture } from "./cut-off.js";
import type { DrawingText } from "./drawing-text.js";

/** The machine's motors bound the plan, so it is part of what is planned with. */
export type PlanSettings = PlotSettings;

/** `drawingKey` names the text; the worker keeps the last drawing, so the text is sent once. */
export interface PlanRequest {
  readonly type: "plan";
  readonly id: number;
  readonly drawingKey: string;
  readonly text: DrawingText | null;
  readonly settings: PlanSettings;
  /** Of the board that is to plot it; null: not known. */
  readonly firmware: string | null;
}

/** The prepared drawing as text, for saving: of the plan that was answered last. */
export interface ExportRequest {
  readonly type: "export";
  readonly format: ExportFormat;
  /** Of the board that the commands are for. */
  readonly firmware: string;
}

export const EXPORT_FORMATS = ["svg", "json", "commands"] as const;
export type ExportFormat = (typeof EXPORT_FORMATS)[number];

export type WorkerRequest = PlanRequest | ExportRequest;

/** Everything the page shows of one drawing under one set of settings. */
export interface Planned {
  readonly drawingKey: string;
  readonly settings: PlanSettings;
  readonly pageWidthMm: number;
  readonly pageHeightMm: number;
  /** From the file's page to the paper, both in mm: x′ = a x + c y + e, y′ = b x + d y + f. */
  readonly pageToPaper: Placement["map"];
  /** The drawing's own box on the paper, before anything is cut off; null for an empty drawing. */
  readonly frameMm: FrameMm | null;
  /** The box of what the pen draws, with nothing that is cut off or hidden; empty if it draws nothing. */
  readonly drawnBox: Box;
  /** Whether the file has filled shapes. */
  readonly hasFills: boolean;
  /** All of the file's, switched-off ones too. */
  readonly layers: readonly PreparedLayer[];
  /** Where the plot waits for a pen. */
  readonly penStops: readonly PenStop[];
  /** Names and colours of the layers that piece and stroke indices mean. */
  readonly drawnLayers: readonly StrokeLayer[];
  /** What of the file can't be drawn, with places on its page. */
  readonly fileWarnings: readonly DrawingWarning[];
  /** What this paper and these settings leave out, and settings that the machine does not use. */
  readonly layoutWarnings: readonly string[];
  /** What the margins cut off. */
  readonly cutOff: CutOffPicture | null;
  readonly strokeCount: number;
  readonly pointCount: number;
  readonly stats: TrajectoryStats;
  readonly trajectory: Trajectory;
  readonly scene: Scene;
  /** The mean distance between a line and the next, where there are lines. */
  readonly lineGapMm: number;
  /** The scene's pieces once more, to be given away to the thread that draws them: copied here, where time is. */
  readonly picture: Picture;
  /** How long the worker took, ms, by stage. */
  readonly tookMs: {
    readonly import: number;
    readonly prepare: number;
    readonly plan: number;
    readonly scene: number;
  };
}

export interface PlanFault {
  readonly code: string;
  readonly message: string;
  /** What failed: reading the file, or laying it out and planning it. */
  readonly stage: "import" | "plan";
}

/** The file has been read: this is how large its page is. */
export interface ImportedReply {
  readonly type: "imported";
  readonly id: number;
  readonly drawingKey: string;
  readonly page: PaperSize;
}

export interface PlannedReply {
  readonly type: "planned";
  readonly id: number;
  readonly planned: Planned;
}

export type WorkerReply =
  | { readonly type: "started"; readonly id: number }
  | ImportedReply
  | PlannedReply
  | { readonly type: "exported"; readonly format: ExportFormat; readonly text: string }
  | { readonly type: "export-failed"; readonly message: string }
  | { readonly type: "fault"; readonly id: number; readonly fault: PlanFault };
