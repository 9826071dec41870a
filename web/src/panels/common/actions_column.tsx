import { pageText } from '../../text/page_text';

/** The head of a column of buttons: its name is for who does not see them. */
export function ActionsColumn() {
  return (
    <th scope="col">
      <span class="visually-hidden">{pageText.actions}</span>
    </th>
  );
}
