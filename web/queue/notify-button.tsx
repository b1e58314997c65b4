import { useState } from "react";
import { useActions } from "../state/use-store.js";
import { notifyText as words } from "./text.js";
import { Button } from "../ui/button.js";

/** Asks for permission to show notifications. Hidden if the browser does not support notifications. */
export const NotifyButton = () => {
  const { notify } = useActions();
  const [permission, setPermission] = useState(() => window.Notification?.permission ?? "denied");
  if (!window.Notification || !window.isSecureContext) return null;
  if (permission === "granted") return <p className="note">{words.asked}</p>;
  const ask = async (): Promise<void> => {
    const answer = await Notification.requestPermission();
    setPermission(answer);
    if (answer === "denied") notify("error", words.denied);
  };
  return (
    <Button kind="link" className="notify-link" onClick={() => void ask()}>
      {words.ask}
    </Button>
  );
};
