import { useCallback } from "react";
import { BackendFault } from "../backend/backend.js";
import { useActions, useBackend, usePageState } from "../state/use-store.js";
import { sharingText as words } from "./text.js";
import { useFetched } from "./use-sharing.js";
import { Button } from "../ui/button.js";

/** Links and QR codes for pairing another device, one for each role. */
export const ShareSection = () => {
  const backend = useBackend();
  const { attempt } = useActions();
  const ask = useCallback(
    () => attempt("pairing", () => backend.operator.pairing().catch(refusal)),
    [backend, attempt],
  );
  const [pairing] = useFetched(ask);
  const localName = usePageState((state) => state.localName);
  if (pairing === null) return null;
  if (pairing === "refused") return <p className="note">{words.pairingWhere}</p>;
  return (
    <>
      {!pairing.isOnLan && <p className="note health">{words.notOnLan}</p>}
      {localName !== null && (
        <p className="note">{words.nameOnNetwork(namedOrigin(pairing.operateUrl, localName))}</p>
      )}
      <div className="pairings">
        <PairingCard
          title={words.operate}
          hint={words.operateHint}
          url={pairing.operateUrl}
          qrSvg={pairing.operateQrSvg}
        />
        <PairingCard
          title={words.submit}
          hint={words.submitHint}
          url={pairing.submitUrl}
          qrSvg={pairing.submitQrSvg}
        />
        <PairingCard
          title={words.watch}
          hint={words.watchHint}
          url={pairing.watchUrl}
          qrSvg={pairing.watchQrSvg}
        />
      </div>
    </>
  );
};

/** Only the server's own computer gets the links. On others that is no error. */
const refusal = (error: unknown): "refused" => {
  if (error instanceof BackendFault && error.code === "not-allowed") return "refused";
  throw error;
};

/** The page's address with the server's name, and the port of `url`. */
const namedOrigin = (url: string, name: string): string => {
  const { protocol, port } = new URL(url);
  return `${protocol}//${name}${port === "" ? "" : `:${port}`}`;
};

interface PairingCardProps {
  readonly title: string;
  readonly hint: string;
  readonly url: string;
  readonly qrSvg: string;
}

const PairingCard = ({ title, hint, url, qrSvg }: PairingCardProps) => {
  const { notify } = useActions();
  const copy = async (): Promise<void> => {
    try {
      await navigator.clipboard.writeText(url);
      notify("info", words.copied);
    } catch {
      notify("error", words.cannotCopy);
    }
  };
  return (
    <section className="pairing" aria-label={title}>
      <h3>{title}</h3>
      <img
        className="qr"
        src={`data:image/svg+xml;charset=utf-8,${encodeURIComponent(qrSvg)}`}
        alt={words.qr(title)}
      />
      <p className="note">{hint}</p>
      <input className="text-field" type="text" readOnly value={url} aria-label={words.linkTo(title)} />
      <Button kind="small" onClick={() => void copy()}>
        {words.copy}
      </Button>
    </section>
  );
};
