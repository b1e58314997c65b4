import { useId } from "react";
import { Icon, type IconName } from "../icon.js";

interface ChooseFileProps {
  readonly label: string;
  /** Types and endings that the browser's dialog lists. */
  readonly accept: string;
  readonly icon?: IconName;
  /** Several files may be chosen. */
  readonly isMultiple?: boolean;
  /** At least one. */
  onFiles(files: readonly File[]): void;
}

/** A button that opens the browser's dialog for a file. */
export const ChooseFile = ({ label, accept, icon, isMultiple, onFiles }: ChooseFileProps) => {
  const id = useId();
  return (
    <div className="choose">
      <input
        id={id}
        type="file"
        accept={accept}
        multiple={isMultiple}
        className="visually-hidden"
        onChange={(event) => {
          const files = [...(event.target.files ?? [])];
          if (files.length > 0) onFiles(files);
          // Otherwise the same file could not be chosen again after it was edited.
          event.target.value = "";
        }}
      />
      <label htmlFor={id} className="button">
        {icon && <Icon name={icon} />}
        {label}
      </label>
    </div>
  );
};
