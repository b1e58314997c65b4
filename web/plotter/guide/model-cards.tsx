import type { ReactNode } from "react";
import { machineById } from "../../../src/index.js";
import type { MachineId } from "../../../src/internal.js";
import { useActions } from "../../state/use-store.js";
import { Button } from "../../ui/button.js";
import { MachinePicture, type MachinePictureName } from "./machine-picture.js";

interface Family {
  readonly name: string;
  /** Ids of its models with what is on their buttons. */
  readonly models: Readonly<Partial<Record<MachineId, string>>>;
}

/** Families that look alike share a drawing. */
interface Card {
  readonly picture: MachinePictureName;
  readonly families: readonly Family[];
}

/** The models that are most common; the list under the cards has all. */
const CARDS: readonly Card[] = [
  {
    picture: "v3",
    families: [
      {
        name: "AxiDraw V3",
        models: { "axidraw-v3": "V3", "axidraw-v3-a3": "A3", "axidraw-v3-xlx": "XLX", "axidraw-v3-b6": "B6" },
      },
    ],
  },
  {
    picture: "se",
    families: [
      {
        name: "AxiDraw SE",
        models: {
          "axidraw-se-a4": "A4",
          "axidraw-se-a3": "A3",
          "axidraw-se-a2": "A2",
          "axidraw-se-a1": "A1",
        },
      },
    ],
  },
  {
    picture: "nextdraw",
    families: [
      {
        name: "NextDraw",
        models: { "nextdraw-8511": "8511", "nextdraw-1117": "1117", "nextdraw-2234": "2234" },
      },
    ],
  },
  {
    picture: "idraw",
    families: [
      { name: "iDraw H", models: { "idraw-h-a4": "A4", "idraw-h-a3": "A3" } },
      { name: "iDraw 2.0", models: { "idraw-2-a4": "A4", "idraw-2-a3": "A3" } },
    ],
  },
];

/** Models of one size: the drawing is in the button. */
const SINGLES = [
  { id: "axidraw-minikit", label: "MiniKit", picture: "mini" },
  { id: "eggbot", label: "EggBot", picture: "egg" },
  { id: "watercolorbot", label: "WaterColorBot", picture: "watercolor" },
] as const;

/** The plotters as drawings, each with a button for each of its sizes. One click chooses the model. */
export const ModelCards = ({ onChoose }: { onChoose(): void }) => {
  const { chooseMachine } = useActions();
  const button = (id: string, content: ReactNode): ReactNode => {
    const machine = machineById(id);
    return (
      <Button
        key={id}
        kind="small"
        aria-label={machine.name}
        onClick={() => {
          chooseMachine(machine);
          onChoose();
        }}
      >
        {content}
      </Button>
    );
  };
  return (
    <div className="model-cards">
      {CARDS.map(({ picture, families }) => (
        <div key={picture} className="model-card">
          <MachinePicture name={picture} />
          {families.map(({ name, models }) => (
            <div key={name}>
              <span className="model-family">{name}</span>
              <span className="model-sizes">
                {Object.entries(models).map(([id, label]) => button(id, label))}
              </span>
            </div>
          ))}
        </div>
      ))}
      <div className="model-singles">
        {SINGLES.map(({ id, label, picture }) =>
          button(
            id,
            <>
              <MachinePicture name={picture} />
              {label}
            </>,
          ),
        )}
      </div>
    </div>
  );
};
