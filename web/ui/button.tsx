import type { ComponentProps } from "react";
import { Icon, type IconName } from "./icon.js";

const CLASSES = {
  plain: "button",
  primary: "button button-primary",
  danger: "button button-danger",
  small: "button button-small",
  icon: "button button-icon",
  smallIcon: "button button-icon button-small",
  tool: "tool",
  link: "link",
} as const;

export type ButtonKind = keyof typeof CLASSES;

interface ButtonProps extends ComponentProps<"button"> {
  readonly kind?: ButtonKind | undefined;
}

/** The attribute `autofocus` alone has no effect on elements that are added later, outside of a dialog. */
const focusNow = (button: HTMLButtonElement | null): void => button?.focus();

/** A button in one of the page's looks. `className` adds to the look. With `autoFocus` it has the focus once it is shown. */
export const Button = ({ kind = "plain", className, autoFocus, ...props }: ButtonProps) => (
  <button
    type="button"
    className={className ? `${CLASSES[kind]} ${className}` : CLASSES[kind]}
    ref={autoFocus ? focusNow : null}
    {...props}
  />
);

interface IconButtonProps extends ButtonProps {
  readonly icon: IconName;
  readonly label: string;
}

/** A button that shows only an icon. */
export const IconButton = ({ icon, label, kind = "smallIcon", ...props }: IconButtonProps) => (
  <Button kind={kind} aria-label={label} title={label} {...props}>
    <Icon name={icon} />
  </Button>
);
