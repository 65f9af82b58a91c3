// SPDX-License-Identifier: Apache-2.0
import {expect, test} from 'vitest';

import {Newest} from '../../src/page/newest';

/** Answers when it is told to. */
function slowServer() {
    const asked: {question: number; answer: () => void; refuse: () => void}[] = [];
    const send = (question: number) => new Promise<string>((resolve, reject) => asked.push({
        question, answer: () => resolve(`to ${question}`), refuse: () => reject(new Error(`not ${question}`)),
    }));
    return {asked, send};
}

const settle = () => new Promise(resolve => setTimeout(resolve));

test('of questions asked while one is under way only the newest is sent', async () => {
    const {asked, send} = slowServer();
    const shown: string[] = [];
    const newest = new Newest(send, answer => shown.push(answer), () => {});
    for (const question of [1, 2, 3, 4]) newest.ask(question);
    expect(asked.map(one => one.question)).toEqual([1]);
    asked[0].answer();
    await settle();
    expect(asked.map(one => one.question)).toEqual([1, 4]);
    asked[1].answer();
    await settle();
    expect(shown).toEqual(['to 1', 'to 4']);
});

test('an answer to a forgotten question is not shown', async () => {
    const {asked, send} = slowServer();
    const shown: string[] = [];
    const newest = new Newest(send, answer => shown.push(answer), () => {});
    newest.ask(1);
    newest.forget();
    newest.ask(2);
    asked[0].answer();
    await settle();
    asked[1].answer();
    await settle();
    expect(shown).toEqual(['to 2']);
});

test('after a failure the newest question is still sent', async () => {
    const {asked, send} = slowServer();
    const shown: string[] = [];
    const failed: unknown[] = [];
    const newest = new Newest(send, answer => shown.push(answer), error => failed.push(error));
    newest.ask(1);
    newest.ask(2);
    asked[0].refuse();
    await settle();
    asked[1].answer();
    await settle();
    expect(failed).toHaveLength(1);
    expect(shown).toEqual(['to 2']);
});
