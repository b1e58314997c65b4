import { useState } from "react";
import { mayOperate } from "../state/store.js";
import { useActions, usePageState } from "../state/use-store.js";
import { presetsText as words } from "./text.js";
import { Button, IconButton } from "../ui/button.js";
import { TextField } from "../ui/fields/text-field.js";

/** Presets: speeds, heights, pens and layers under a name. */
export const PresetList = () => {
  const presets = usePageState((state) => state.presets);
  // They are stored with the plotter.
  const mayChange = usePageState(mayOperate);
  const { takePreset, removePreset } = useActions();
  return (
    <>
      <p className="note">{words.hint}</p>
      <ul className="preset-list">
        {presets.map((preset) => (
          <li key={preset.name}>
            <Button onClick={() => takePreset(preset)}>{preset.name}</Button>
            {mayChange && (
              <IconButton
                kind="icon"
                icon="close"
                label={words.remove(preset.name)}
                onClick={() => removePreset(preset.name)}
              />
            )}
          </li>
        ))}
      </ul>
      {mayChange && <SavePreset />}
    </>
  );
};

const SavePreset = () => {
  const { savePreset } = useActions();
  const [name, setName] = useState("");
  return (
    <form
      className="field-with-button"
      onSubmit={(event) => {
        event.preventDefault();
        if (name.trim() !== "") savePreset(name);
        setName("");
      }}
    >
      <TextField label={words.name} isLabelInside maxLength={60} value={name} onChange={setName} />
      <Button type="submit" disabled={name.trim() === ""}>
        {words.save}
      </Button>
    </form>
  );
};
