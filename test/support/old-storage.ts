/** The contents of a browser and of a server's database from before the server stored heights, pens and presets. */
import { join } from "node:path";
import sqlite from "node-sqlite3-wasm";
import { prepareDataDir } from "../../server/storage/data-dir.js";
import { Store } from "../../server/storage/store.js";

/** Makes a database of version 7 with one plotter, whose model was never set. */
export function makeOldDatabase(dataDir: string): void {
  prepareDataDir(dataDir);
  const store = Store.open(dataDir);
  store.savePlotter({ id: "main", name: "Desk", device: "virtual", machine: null });
  store.close();
  const db = new sqlite.Database(join(dataDir, "plotwright.db"));
  db.exec(
    "PRAGMA locking_mode = EXCLUSIVE; ALTER TABLE plotters DROP COLUMN settings; PRAGMA user_version = 7",
  );
  db.close();
}

/** The settings exactly as the page of that version wrote them, except for model and heights, which its user had set. */
const OLD_SETTINGS = `{"machine":"axidraw-se-a3","prepare":{"landscape":true,"marginMm":15,"fit":true,"rotateDeg":0,"mirror":"none","clipToMargins":true,"cropToPage":false,"outlineFills":true,"hideCovered":false,"joinMm":0.1,"dropShorterMm":0,"dropRepeatsMm":0,"simplifyMm":0,"flattenMm":0.02,"smoothRounds":0,"reloop":false,"order":"fast","orderS":9,"spread":"none","reinkMm":0,"layers":"group","paper":{"widthMm":210,"heightMm":297},"hiddenLayers":[],"shownLayers":[],"layerOrder":[],"layerRepeats":{},"margins":null,"place":null,"reach":null,"hatch":{"spacingMm":0,"angleDeg":45,"cross":false},"layerHatches":[]},"motion":{"mode":"blend","draw":{"speedMmPerS":50,"accelMmPerS2":500,"cornerMm":0.025,"jerkMmPerS3":10000},"travel":{"speedMmPerS":150,"accelMmPerS2":1000,"cornerMm":0.5,"jerkMmPerS3":20000},"fit":{"toleranceMm":0.02,"floorMs":15}},"pen":{"upPct":66,"downPct":41,"liftMs":250,"dropMs":300},"pens":[{"id":"pen-1","name":"Gold","color":"#c0a020","widthMm":0.7,"offsetXMm":0,"offsetYMm":0}],"layerPens":{},"penStops":"pens","layerStops":{},"sendAheadMs":300,"customMachine":null}`;

/** localStorage of such a browser: its keys and their text. */
export const OLD_BROWSER: Readonly<Record<string, string>> = {
  "plotwright.page.v1": `{"settings":${OLD_SETTINGS},"view":{"showTravel":false,"colorBy":"speed","showGraph":false,"theme":"auto","openGroups":["drawing","paper","layers","motion"],"cameraUrl":"","cameraEveryS":0}}`,
  "plotwright.presets.v1": `[{"name":"Brush","motion":${motionOf(OLD_SETTINGS)},"pen":{"upPct":70,"downPct":35,"liftMs":300,"dropMs":400}}]`,
};

function motionOf(settings: string): string {
  return JSON.stringify((JSON.parse(settings) as { motion: unknown }).motion);
}
