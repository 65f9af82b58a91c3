// SPDX-License-Identifier: Apache-2.0
// Messages about a bake whose scene, groups or volume was deleted, and what the user can do.
import {ApiError, Bake, titleOf, Unreachable} from '../page/api';

const kResults: Record<Bake['kind'], string> = {
    volumes: 'The volume', lightmaps: 'The lightmaps', reflections: 'The reflection probes',
};
const kVerbs: Record<Bake['kind'], string> = {volumes: 'was', lightmaps: 'were', reflections: 'were'};

/** The words of the service, unless a file or the bake itself is gone: then what that means for this bake. */
export function explain(error: unknown, bake: Pick<Bake, 'kind' | 'name' | 'id'>): unknown {
    if (!(error instanceof ApiError) || error.status !== 404) return error;
    const name = titleOf(bake);
    const say = (words: string) => new ApiError(error.status, error.code, words, error.field);
    if (error.field === 'bake') {
        return say(`The bake ${name} is not in the list of the server any more. Files that it made are kept: ` +
                   'choose them above the view, or order the bake again.');
    }
    if (error.field === 'scene') {
        return say(`The scene of the bake ${name} was deleted. Upload it again, or open another scene and order the bake with it.`);
    }
    return say(`${kResults[bake.kind]} of the bake ${name} ${kVerbs[bake.kind]} deleted. ` +
               '"Use its settings" fills the form to bake again.');
}

/** An order that was on its way when the server went away may have arrived or not. */
export function explainOrder(error: unknown): unknown {
    return !(error instanceof Unreachable) ? error :
        new Error('The server did not answer the order of a bake. When it answers again, order the bake once more if it is ' +
                  'not in the list.');
}

/** What to do about a bake that failed. */
export const kAfterFailure = '"Use its settings" fills the form: change what is wrong there, and bake again.';
