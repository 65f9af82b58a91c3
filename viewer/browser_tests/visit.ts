// SPDX-License-Identifier: Apache-2.0
import type {Page} from 'playwright-core';
import {expect} from 'vitest';

import {newContext, Options} from './browser';

/** Works with a page; by its end the console has had no error and no alert is shown that was not meant. */
export async function visit(url: string, work: (page: Page) => Promise<void>, options: Options = {}): Promise<void> {
    const context = await newContext(options);
    const page = await context.newPage();
    const errors: string[] = [];
    page.on('console', message => {
        if (message.type() === 'error' && !options.refusal?.test(message.text())) errors.push(message.text());
    });
    page.on('pageerror', error => errors.push(String(error)));
    await page.goto(url);
    try {
        await work(page);
    } catch (error) {
        const alert = await page.textContent('#banner').catch(() => '');
        throw Object.assign(error as Error, {message: `${(error as Error).message}\nalert: ${alert}\n${errors.join('\n')}`});
    }
    expect(errors).toEqual([]);
    if (options.refusal === undefined) expect(await page.locator('#banner').isHidden(), 'no alert').toBe(true);
    await context.close();
}
