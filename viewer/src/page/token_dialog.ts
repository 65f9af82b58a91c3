// SPDX-License-Identifier: Apache-2.0
import {element, labelled} from './dom';

/** Asks for the server's token; one at a time. */
export class TokenDialog {
    private readonly input = element('input', {type: 'password', autocomplete: 'off'});
    private readonly words = element('p');
    private readonly dialog: HTMLDialogElement;

    constructor(private readonly given: (token: string) => void) {
        this.dialog = element(
            'dialog', {'aria-labelledby': 'token-title'}, element('h2', {id: 'token-title'}, 'This server needs a token'),
            this.words, element('form', {submit: (event: Event) => {
                event.preventDefault();
                this.dialog.close();
                this.given(this.input.value);
            }}, labelled('Token', this.input, 'The token that `tetralight serve` was started with. Only this tab remembers it.'),
            element('div', {class: 'buttons'}, element('button', {type: 'submit', class: 'main'}, 'Enter'))));
        document.body.append(this.dialog);
    }

    ask(hadOne: boolean): void {
        if (this.dialog.open) return;
        this.words.textContent = hadOne ? 'The token is wrong.' : '';
        this.words.className = hadOne ? 'error' : '';
        this.input.value = '';
        this.dialog.showModal();
    }
}
