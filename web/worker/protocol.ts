/** Messages between the page and its workers. Arrays and pictures are transferred, never copied. */
import type { StrokeSet, Trajectory } from "../../src/index.js";
import type {
  Box,
  DrawingWarning,
  DrawnSize,
  OutsidePaper,
  PaperInPx,
  PenStop,
  Layout,
  PreparedLayer,
  SheetItem,
  SheetSource,
  Springs,
  StrokeLayer,
  TrajectoryStats,
} from "../../src/internal.js";
import type { PlotSettings } from "../../src/schema/index.js";
import type { FileExtent } from "../scene/arrange.js";
import type { FrameMm } from "../scene/placing.js";
import type { Frame, Picture } from "../scene/renderer.js";
import type { Scene } from "../scene/scene.js";
import type { SwingPicture } from "../scene/swing-scene.js";
import type { CutOffPicture } from "./cut-off.js";
import type { OutsideChoices } from "./outside-choices.js";
import type { DrawingText } from "../backend/drawing-text.js";

/** A file of the drawing. The worker stores those of the last request, so each text is sent once: null after that. */
export interface WorkerFile {
  /** Identifies the text. */
  readonly key: string;
  readonly text: DrawingText | null;
}

/** Several drawings on a sheet. */
export interface SheetOnPaper {
  /** By the index of the file in the request. */
  readonly names: readonly Pick<SheetSource, "name" | "layerPrefix">[];
  readonly items: readonly SheetItem[];
}

/** A file on the page's sheet. */
export interface SheetSourceFile extends Pick<SheetSource, "name" | "layerPrefix"> {
  /** Identifies the text. */
  readonly key: string;
  readonly text: DrawingText;
  readonly extent: FileExtent;
}

/** One of the drawings on the page's sheet. */
export interface SheetPiece {
  readonly id: string;
  readonly fileKey: string;
  readonly map: SheetItem["map"];
  readonly isCropped: boolean;
}

/** Several drawings on a sheet, as the page keeps them. */
export interface PageSheet {
  readonly files: readonly SheetSourceFile[];
  /** In paint order. */
  readonly pieces: readonly SheetPiece[];
}

export interface WorkerPlanRequest {
  readonly type: "plan";
  readonly id: number;
  readonly drawingKey: string;
  /** One, or those of the sheet. */
  readonly files: readonly WorkerFile[];
  readonly sheet: SheetOnPaper | null;
  readonly settings: PlotSettings;
  /** Firmware of the board that will plot it; null: unknown. */
  readonly firmware: string | null;
}

/** Requests the prepared drawing of the last plan as text, for saving. */
export interface ExportRequest {
  readonly type: "export";
  readonly format: ExportFormat;
  /** Firmware of the board that the commands are for. */
  readonly firmware: string;
}

export const EXPORT_FORMATS = ["svg", "json", "commands"] as const;
export type ExportFormat = (typeof EXPORT_FORMATS)[number];

/** Requests a copy of a plan's strokes, to simulate the pen on them. */
export interface StrokesRequest {
  readonly type: "strokes";
  /** The plan's id. */
  readonly id: number;
}

/** Requests small pictures of the last plan's drawing, each with other settings. */
export interface SketchRequest {
  readonly type: "sketches";
  /** The plan's id. */
  readonly id: number;
  readonly changes: readonly Partial<PlotSettings["prepare"]>[];
}

/** Asks what a file draws, before it is on the sheet. */
export interface MeasureRequest {
  readonly type: "measure";
  readonly file: WorkerFile;
}

export type WorkerRequest =
  WorkerPlanRequest | ExportRequest | StrokesRequest | SketchRequest | MeasureRequest;

/** A small picture of a drawing: polylines in mm. */
export interface Sketch {
  readonly box: Box;
  /** mm x, y, x, y … of line i from point `offsets[i]` to point `offsets[i + 1]`. */
  readonly xy: StrokeSet["xy"];
  readonly offsets: StrokeSet["offsets"];
}

/** The data that the page shows for one drawing with one set of settings. */
export interface Planned {
  readonly drawingKey: string;
  readonly settings: PlotSettings;
  readonly pageWidthMm: number;
  readonly pageHeightMm: number;
  /** Px per inch of the file's page; null if it is not given in px. */
  readonly pxPerInch: number | null;
  /** The papers that the page would be with other px per inch. */
  readonly otherPapers: readonly PaperInPx[];
  /** Maps the file's page to the paper, both in mm: x′ = a x + c y + e, y′ = b x + d y + f. */
  readonly pageToPaper: Layout["map"];
  /** The same for the file as it was read: before its px have the size that the user has chosen. */
  readonly fileToPaper: Layout["map"];
  /** The drawing's box on the paper, before anything is cut off; null for an empty drawing. */
  readonly frameMm: FrameMm | null;
  readonly choice: Layout["choice"];
  readonly size: DrawnSize;
  /** Strokes that leave the paper. */
  readonly outside: OutsidePaper | null;
  readonly outsideChoices: OutsideChoices | null;
  /** The box of all lines that the pen draws, without lines that are cut off or hidden; empty if there are none. */
  readonly drawnBox: Box;
  /** How many shapes of the file are filled, without its background. */
  readonly fillCount: number;
  /** All layers of the file, including those that are switched off. */
  readonly layers: readonly PreparedLayer[];
  /** Where the plot stops for a pen change. */
  readonly penStops: readonly PenStop[];
  /** The layers that the indices of pieces and strokes refer to. */
  readonly drawnLayers: readonly StrokeLayer[];
  /** Parts of the file that can't be drawn, with their places on its page. */
  readonly fileWarnings: readonly DrawingWarning[];
  /** What paper and settings leave out, and settings that the machine does not use. */
  readonly layoutWarnings: readonly string[];
  /** The lines that the margins or the paper's edge cut off. */
  readonly cutOff: CutOffPicture | null;
  /** The lines that leave the paper and are not cut off. */
  readonly besidePaper: CutOffPicture | null;
  /** The number of strokes that the machine can't reach, or only in part. */
  readonly unreachedCount: number;
  readonly strokeCount: number;
  readonly stats: TrajectoryStats;
  readonly trajectory: Trajectory;
  readonly scene: Scene;
  /** The mean distance between neighbouring lines, where there are lines. */
  readonly lineGapMm: number;
  /** A copy of the scene's pieces for the drawing worker. The planning worker makes it, to save the page time. */
  readonly picture: Picture;
}

/** What a file draws, or why it can't be read. */
export type FileMeasured = FileExtent | { readonly fault: string };

export interface PlanFault {
  readonly message: string;
  /** What failed: reading the file, or preparing and planning it. */
  readonly stage: "import" | "plan";
}

/** The file has been read. */
interface ImportedReply {
  readonly type: "imported";
  readonly id: number;
  readonly drawingKey: string;
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
  | { readonly type: "strokes"; readonly id: number; readonly strokes: StrokeSet }
  | { readonly type: "sketches"; readonly id: number; readonly sketches: readonly Sketch[] }
  | { readonly type: "measured"; readonly key: string; readonly measured: FileMeasured }
  | { readonly type: "fault"; readonly id: number; readonly fault: PlanFault };

/** To the drawing worker. */
export type DrawRequest =
  | { readonly type: "scene"; readonly scene: Picture | null }
  /** Only the newest is drawn. */
  | { readonly type: "show"; readonly id: number; readonly frame: Frame };

export interface DrawReply {
  /** The frame's id. */
  readonly id: number;
  /** False for a coarse picture. The whole one follows, unless another frame is requested. */
  readonly isWhole: boolean;
  readonly bitmap: ImageBitmap;
}

/** To the worker that simulates the pen. It answers one request, then it is terminated. */
export interface SwingRequest {
  readonly strokes: StrokeSet;
  readonly trajectory: Trajectory;
  readonly springs: Springs;
}

export type SwingReply =
  | { readonly type: "share"; readonly share: number }
  | { readonly type: "done"; readonly picture: SwingPicture };
