// SPDX-License-Identifier: Apache-2.0
import {element} from './dom';

interface Tab {
    id: string;
    title: string;
    panel: HTMLElement;
}

/** Tabs as screen readers know them: arrow keys go from one to the next, Enter and the space bar open it. */
export class Tabs {
    readonly element: HTMLElement;
    current = '';
    private readonly scrolls = new Map<string, number>();
    private readonly buttons: HTMLButtonElement[];

    constructor(private readonly tabs: Tab[], first: string, private readonly opened: (id: string) => void) {
        this.buttons = tabs.map(({id, title}) => element('button', {
            type: 'button', role: 'tab', id: `tab-${id}`, 'aria-controls': `panel-${id}`,
            click: () => this.open(id), keydown: (event: KeyboardEvent) => this.step(event),
        }, title));
        const panels = tabs.map(({id, panel}) => element(
            'div', {role: 'tabpanel', id: `panel-${id}`, 'aria-labelledby': `tab-${id}`}, panel));
        this.element = element('div', {class: 'tabs'},
                               element('div', {role: 'tablist', 'aria-label': 'Controls'}, ...this.buttons), ...panels);
        this.open(first);
    }

    open(id: string): void {
        if (!this.tabs.some(tab => tab.id === id)) return;
        const scroller = this.element.parentElement;
        if (scroller !== null) this.scrolls.set(this.current, scroller.scrollTop);
        this.current = id;
        this.tabs.forEach((tab, i) => {
            const isOpen = tab.id === id;
            this.buttons[i].setAttribute('aria-selected', String(isOpen));
            this.buttons[i].tabIndex = isOpen ? 0 : -1;
            tab.panel.parentElement!.hidden = !isOpen;
        });
        if (scroller !== null) scroller.scrollTop = this.scrolls.get(id) ?? 0;
        this.opened(id);
    }

    private step(event: KeyboardEvent): void {
        const way = {ArrowRight: 1, ArrowLeft: -1}[event.key];
        if (way === undefined) return;
        const at = this.buttons.indexOf(event.currentTarget as HTMLButtonElement);
        this.buttons[(at + way + this.tabs.length) % this.tabs.length].focus();
    }
}
