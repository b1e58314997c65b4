import { Icon, type IconName } from "./icon.js";

interface IconButtonProps {
  readonly icon: IconName;
  readonly label: string;
  readonly isOff?: boolean;
  onClick(): void;
}

export const IconButton = ({ icon, label, isOff, onClick }: IconButtonProps) => (
  <button
    type="button"
    className="button button-icon button-small"
    aria-label={label}
    title={label}
    disabled={isOff}
    onClick={onClick}
  >
    <Icon name={icon} />
  </button>
);
