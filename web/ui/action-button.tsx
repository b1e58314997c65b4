import { isOffered, labelOf, whyOff, type PageAction } from "../state/page-action.js";
import { usePage, usePageState } from "../state/use-store.js";
import { Button, IconButton, type ButtonKind } from "./button.js";
import { Icon, type IconName } from "./icon.js";

interface ActionButtonProps {
  readonly action: PageAction;
  readonly kind?: ButtonKind;
  /** Shows the icon alone; the label is its name. */
  readonly icon?: IconName;
  /** More about the action than its label. */
  readonly hint?: string;
  readonly className?: string;
  /** Shows the label beside the icon. */
  readonly hasText?: boolean;
  readonly isPressed?: boolean;
  readonly isBusy?: boolean;
  /** Called before the action is performed. */
  readonly onPress?: (() => void) | undefined;
}

/** The button of an action: named by its record, off when it can't be performed, absent if this page does not have it. */
export const ActionButton = (props: ActionButtonProps) => {
  const { action, icon, hint, hasText, isPressed, isBusy, onPress, ...look } = props;
  const page = usePage();
  const isHere = usePageState(() => isOffered(action, page));
  const label = usePageState((state) => labelOf(action, state));
  const isOff = usePageState((state) => whyOff(action, state) !== null);
  if (!isHere) return null;
  const all = {
    ...look,
    disabled: isOff,
    "aria-pressed": isPressed,
    "aria-busy": isBusy,
    onClick: () => {
      onPress?.();
      action.perform(page);
    },
  };
  const key = action.key === undefined ? "" : ` (${action.key})`;
  if (icon && !hasText) return <IconButton icon={icon} label={label} title={label + key} {...all} />;
  return (
    <Button title={hint} {...all}>
      {icon && <Icon name={icon} />}
      {icon ? <span>{label}</span> : label}
    </Button>
  );
};
