import type { PageState } from "../state/store.js";
import { Button } from "../ui/button.js";
import { Dialog } from "../ui/dialog.js";
import { takeOverText as words } from "./text.js";

/** Asks before an action that only the operator may do, while another browser is the operator. */
export const TakeOver = ({ question }: { question: NonNullable<PageState["takeOverQuestion"]> }) => (
  <Dialog title={words.title} onClose={() => question.answer(false)}>
    <p>{words.operating(question.operator)}</p>
    <p className="note">{words.hint}</p>
    <div className="button-row">
      <Button kind="primary" onClick={() => question.answer(true)}>
        {words.takeOver}
      </Button>
      <Button onClick={() => question.answer(false)}>{words.keep}</Button>
    </div>
  </Dialog>
);
