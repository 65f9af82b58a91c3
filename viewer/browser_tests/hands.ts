// SPDX-License-Identifier: Apache-2.0
// Who uses the page, by pointer or by keyboard alone. Each use of a control is one action; to reach it is none.
import type {Locator, Page} from 'playwright-core';

export abstract class Hands {
    actions = 0;

    constructor(readonly page: Page) {}

    /** Button, tab, check box, radio button, summary. */
    press(control: Locator): Promise<void> {
        ++this.actions;
        return this.doPress(control);
    }

    /** By what the list says. */
    choose(list: Locator, option: string): Promise<void> {
        ++this.actions;
        return this.doChoose(list, option);
    }

    async enter(field: Locator, text: string): Promise<void> {
        ++this.actions;
        await this.focus(field);
        await this.page.keyboard.press('Control+a');
        await this.page.keyboard.type(text);
        await this.page.keyboard.press('Tab');
    }

    slide(slider: Locator, value: number): Promise<void> {
        ++this.actions;
        return this.doSlide(slider, value);
    }

    /** Something in the view or at the divider: what the mouse does, or the keys for it. */
    async inView(control: Locator, byMouse: () => Promise<void>, keys: string[]): Promise<void> {
        ++this.actions;
        await this.doInView(control, byMouse, keys);
    }

    protected abstract focus(control: Locator): Promise<void>;
    protected abstract doPress(control: Locator): Promise<void>;
    protected abstract doChoose(list: Locator, option: string): Promise<void>;
    protected abstract doSlide(slider: Locator, value: number): Promise<void>;
    protected abstract doInView(control: Locator, byMouse: () => Promise<void>, keys: string[]): Promise<void>;
}

export class Pointer extends Hands {
    protected focus(control: Locator): Promise<void> {
        return control.click();
    }

    protected doPress(control: Locator): Promise<void> {
        return control.click();
    }

    protected async doChoose(list: Locator, option: string): Promise<void> {
        await list.selectOption({label: option});
    }

    /** A click at the place of the value. */
    protected async doSlide(slider: Locator, value: number): Promise<void> {
        const kThumb = 16;
        await slider.scrollIntoViewIfNeeded();
        const place = await slider.evaluate((input, [to, thumb]) => {
            const {min, max} = input as HTMLInputElement;
            const {left, width, top, height} = input.getBoundingClientRect();
            const inset = parseFloat(getComputedStyle(input).paddingLeft) + input.clientLeft + thumb / 2;
            return {x: left + inset + (width - 2 * inset) * (to - Number(min)) / (Number(max) - Number(min)), y: top + height / 2};
        }, [value, kThumb]);
        await this.page.mouse.click(place.x, place.y);
    }

    protected doInView(_: Locator, byMouse: () => Promise<void>): Promise<void> {
        return byMouse();
    }
}

export class Keyboard extends Hands {
    /** By Tab; of tabs and radio buttons, which are one stop, by arrow keys from there. */
    protected async focus(control: Locator): Promise<void> {
        const {keyboard} = this.page;
        for (let hops = 0; ; ++hops) {
            const key = await control.evaluate(keyTowards);
            if (key === null) return;
            if (hops === 200) throw new Error(`Tab does not reach ${control}`);
            await keyboard.press(key);
        }
    }

    protected async doPress(control: Locator): Promise<void> {
        await this.focus(control);
        const type = await control.getAttribute('type');
        if (type !== 'radio') await this.page.keyboard.press(type === 'checkbox' ? 'Space' : 'Enter');
    }

    /** By typing what the list says; on a slow machine a late key begins another word, and arrow keys go the rest of the way. */
    protected async doChoose(list: Locator, option: string): Promise<void> {
        const {keyboard} = this.page;
        await this.focus(list);
        await keyboard.type(option);
        const steps = await list.evaluate((element, wanted) => {
            const {options, selectedIndex} = element as HTMLSelectElement;
            return [...options].findIndex(({text}) => text.startsWith(wanted)) - selectedIndex;
        }, option);
        for (let i = 0; i < Math.abs(steps); ++i) await keyboard.press(steps > 0 ? 'ArrowDown' : 'ArrowUp');
    }

    protected async doSlide(slider: Locator, value: number): Promise<void> {
        await this.focus(slider);
        const [least, most, step] = await Promise.all(
            ['min', 'max', 'step'].map(async name => Number(await slider.getAttribute(name))));
        if (value === least || value === most) return this.page.keyboard.press(value === least ? 'Home' : 'End');
        const steps = Math.round((value - Number(await slider.inputValue())) / step);
        for (let i = 0; i < Math.abs(steps); ++i) await this.page.keyboard.press(steps > 0 ? 'ArrowRight' : 'ArrowLeft');
    }

    protected async doInView(control: Locator, _: () => Promise<void>, keys: string[]): Promise<void> {
        await this.focus(control);
        for (const key of keys) await this.page.keyboard.press(key);
    }
}

/** The next key on the way from what has the focus to a control; null: it has the focus. Runs in the page. */
function keyTowards(wanted: Element): string | null {
    const focused = document.activeElement!;
    const groupOf = (one: Element): Element[] => {
        if (one.matches('[role=tab]')) return [...one.parentElement!.children];
        if (!one.matches('[type=radio]')) return [one];
        return [...document.querySelectorAll('[type=radio]')].filter(
            other => other.getAttribute('name') === one.getAttribute('name'));
    };
    if (focused === wanted) return null;
    const group = groupOf(wanted);
    const at = group.indexOf(focused);
    if (at >= 0) return at < group.indexOf(wanted) ? 'ArrowRight' : 'ArrowLeft';
    return wanted.compareDocumentPosition(focused) & Node.DOCUMENT_POSITION_FOLLOWING ? 'Shift+Tab' : 'Tab';
}
