// SPDX-License-Identifier: Apache-2.0
import type {Api} from '../page/api';
import {Groups, parseGroups} from './groups';

export async function readGroups(api: Api, reference: string): Promise<Groups> {
    const answer = await api.request('GET', `/v1/groups/${encodeURIComponent(reference)}/file`);
    return parseGroups(await answer.text());
}
