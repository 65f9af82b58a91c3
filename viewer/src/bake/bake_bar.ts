// SPDX-License-Identifier: Apache-2.0
// The bar at the bottom of the bakes: the button that orders one, and how far the current one is.
import {Bake, titleOf} from '../page/api';
import {button, element} from '../page/dom';
import {countsOf, isUnderWay, shortProgressOf} from './bake_progress';

export class BakeBar {
    readonly element: HTMLElement;
    private readonly bar = element('progress', {'aria-label': 'Progress of the bake'});
    private readonly words = element('span', {class: 'facts'});
    private readonly work: HTMLElement;
    private shown = '';

    /** `form`: id of the form that the button sends. */
    constructor(form: string, cancel: (bake: string) => void) {
        this.work = element('div', {class: 'work', hidden: true}, this.bar, this.words,
                            button('Cancel', () => cancel(this.shown), {'aria-label': 'Cancel the bake'}));
        this.element = element('div', {class: 'bake-bar'}, this.work,
                               element('button', {type: 'submit', form, class: 'main'}, 'Bake'));
    }

    /** Shows the bake that runs, or else the first that waits. */
    show(bakes: readonly Bake[]): void {
        const bake = bakes.find(({state}) => state === 'running') ?? bakes.find(isUnderWay);
        this.work.hidden = bake === undefined;
        this.shown = bake?.id ?? '';
        if (bake === undefined) return;
        const {done, count} = countsOf(bake);
        this.bar.max = Math.max(1, count);
        this.bar.value = done;
        this.words.textContent = `${titleOf(bake)}: ${shortProgressOf(bake)}`;
    }
}
