// SPDX-License-Identifier: Apache-2.0
// What lies over the view while two lights are compared: a divider to drag, and what each side shows.
import {button, element} from '../page/dom';

const kStep = 0.02;

export class Wipe {
    readonly element: HTMLElement;
    private readonly handle: HTMLElement;
    private readonly labels = [0, 1].map(side => element('p', {class: `side ${side === 0 ? 'left' : 'right'}`}));
    private readonly legend = element('div', {class: 'legend'});
    private split = 0.5;

    /** `change` hears of the divider, `stop` of the button that ends the comparison. */
    constructor(private readonly parent: HTMLElement, private readonly change: (split: number) => void, stop: () => void) {
        this.handle = element('div', {
            class: 'divider', role: 'slider', tabindex: 0, 'aria-label': 'Divider between left and right',
            'aria-orientation': 'horizontal', 'aria-valuemin': 0, 'aria-valuemax': 100,
            keydown: (event: KeyboardEvent) => this.step(event),
            pointerdown: (event: PointerEvent) => this.hold(event),
            pointermove: (event: PointerEvent) => this.drag(event),
        }, element('span', {class: 'knob', 'aria-hidden': 'true'}, '◂ ▸'));
        this.element = element('div', {class: 'compare', hidden: true}, ...this.labels, this.handle, this.legend,
                               button('Stop comparing', stop, {class: 'stop'}));
        parent.append(this.element);
    }

    show(titles: readonly [string, string], split: number): void {
        this.element.hidden = false;
        this.handle.hidden = false;
        this.element.classList.remove('difference');
        this.legend.replaceChildren();
        this.labels.forEach((label, i) => { label.textContent = `${i === 0 ? 'Left' : 'Right'}: ${titles[i]}`; });
        this.place(split);
    }

    showDifference(titles: readonly [string, string], legend: HTMLElement): void {
        this.element.hidden = false;
        this.handle.hidden = true;
        this.element.classList.add('difference');
        this.labels[0].textContent = `Difference of “${titles[1]}” to “${titles[0]}”`;
        this.labels[1].textContent = '';
        this.legend.replaceChildren(legend);
    }

    hide(): void {
        this.element.hidden = true;
    }

    private place(split: number): void {
        this.split = split;
        const percent = Math.round(100 * split);
        this.handle.style.left = `${100 * split}%`;
        this.handle.setAttribute('aria-valuenow', String(percent));
        this.handle.setAttribute('aria-valuetext', `${percent} % from the left`);
    }

    private move(split: number): void {
        this.place(Math.min(1, Math.max(0, split)));
        this.change(this.split);
    }

    private hold(event: PointerEvent): void {
        event.preventDefault();
        this.handle.focus();
        this.handle.setPointerCapture(event.pointerId);
    }

    private drag(event: PointerEvent): void {
        if (!this.handle.hasPointerCapture(event.pointerId)) return;
        const {left, width} = this.parent.getBoundingClientRect();
        this.move((event.clientX - left) / width);
    }

    private step(event: KeyboardEvent): void {
        const step = event.shiftKey ? 5 * kStep : kStep;
        const to: Record<string, number> = {
            ArrowLeft: this.split - step, ArrowDown: this.split - step, ArrowRight: this.split + step,
            ArrowUp: this.split + step, PageDown: this.split - 5 * kStep, PageUp: this.split + 5 * kStep, Home: 0, End: 1,
        };
        if (!(event.key in to)) return;
        event.preventDefault();
        event.stopPropagation();
        this.move(to[event.key]);
    }
}
