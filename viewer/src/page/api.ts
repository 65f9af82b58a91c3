// SPDX-License-Identifier: Apache-2.0
// The service of `tetralight serve`, as server/openapi.json describes it.

export type Kind = 'scenes' | 'skies' | 'groups' | 'volumes' | 'reflections';

export interface StoredFile {
    id: string;
    name: string;  // the first of them
    names: string[];
    bytes: number;
    created: number;
    state: 'ready' | 'quarantined';
    damage?: string;
    facts?: Record<string, unknown>;
    /** Of what made it, in the answer to that. */
    report?: Record<string, unknown>;
}

/** Whether it is new tells whether it may be deleted again. */
export interface Kept {
    file: StoredFile;
    isNew: boolean;
}

export interface Bake {
    id: string;
    kind: 'volumes' | 'lightmaps' | 'reflections';
    state: 'queued' | 'running' | 'done' | 'failed' | 'cancelled' | 'deleted';
    name: string;
    created: number;
    ended?: number;
    probes_done?: number;  // of volumes
    probe_count?: number;
    texels_done?: number;  // of lightmaps
    texel_count?: number;
    rows_done?: number;  // of reflection probes: rows of texels of the cubes
    row_count?: number;
    at_target?: number | null;  // null: not known, or no target
    share_at_target?: number | null;
    preview?: number | null;  // the number of the newest
    rays_per_second?: number | null;  // null: not known yet
    seconds_left?: number | null;
    volume?: string;
    lightmaps?: string;
    reflections?: string;
    error?: string;
    report?: Record<string, unknown>;
    request?: Record<string, unknown>;
}

/** What the server refused, in its own words. */
export class ApiError extends Error {
    constructor(readonly status: number, readonly code: string, message: string,
                readonly field = '') {
        super(message);
    }
}

/** There was no answer. */
export class Unreachable extends Error {}

export interface Connection {
    lost(): void;
    found(): void;
    unauthorized(): void;
}

const kAttendMilliseconds = 3000;
const kTokenKey = 'tetralight-token';

export class Api {
    private isLost = false;
    /** Of the files in lists, by id. */
    private readonly titles = new Map<string, string>();

    constructor(private readonly connection: Connection) {}

    get token(): string {
        return sessionStorage.getItem(kTokenKey) ?? '';
    }

    set token(token: string) {
        sessionStorage.setItem(kTokenKey, token);
    }

    async request(method: string, path: string, body?: BodyInit, type?: string,
                  signal?: AbortSignal): Promise<Response> {
        const headers: Record<string, string> = {};
        if (this.token !== '') headers.Authorization = `Bearer ${this.token}`;
        if (type !== undefined) headers['Content-Type'] = type;
        let response: Response;
        try {
            response = await fetch(path, {method, headers, body, signal});
        } catch (error) {
            throw this.broken(error, signal);
        }
        if (this.isLost) this.find();
        if (response.ok) return response;
        throw await this.refusal(response);
    }

    async get<T>(path: string): Promise<T> {
        return (await this.request('GET', path)).json() as Promise<T>;
    }

    async bytes(path: string): Promise<ArrayBuffer> {
        return (await this.request('GET', path)).arrayBuffer();
    }

    async post<T>(path: string, body: unknown): Promise<T> {
        const answer = await this.request('POST', path, JSON.stringify(body), 'application/json');
        return answer.json() as Promise<T>;
    }

    /** A file that a request makes and the server does not keep. */
    async make(path: string, body: unknown): Promise<ArrayBuffer> {
        const answer = await this.request('POST', path, JSON.stringify(body), 'application/json');
        return answer.arrayBuffer();
    }

    /** All files of a kind, the newest first. */
    async list(kind: Kind): Promise<StoredFile[]> {
        const files: StoredFile[] = [];
        for (let after: string | null = ''; after !== null;) {
            const path: string = `/v1/${kind}` + (after === '' ? '' : `?after=${after}`);
            const page: Record<string, unknown> = await this.get(path);
            files.push(...(page[kind] as StoredFile[]));
            after = page.next as string | null;
        }
        for (const file of files) this.titles.set(file.id, titleOf(file));
        return files.sort((a, b) => b.created - a.created);
    }

    async upload(kind: Kind, body: BodyInit, name = ''): Promise<Kept> {
        const query = name === '' ? '' : `?name=${encodeURIComponent(name)}`;
        const type = kind === 'groups' ? 'application/json' : 'application/octet-stream';
        return kept(await this.request('POST', `/v1/${kind}${query}`, body, type));
    }

    /** Groups or a volume that the server makes and keeps. */
    async keep(path: '/v1/grid' | '/v1/tetrahedralize', order: unknown): Promise<Kept> {
        return kept(await this.request('POST', path, JSON.stringify(order), 'application/json'));
    }

    async remove(path: string): Promise<void> {
        await this.request('DELETE', path);
    }

    /**
     * All bakes that are under way or are ordered meanwhile, until the signal. One connection for all of them: a
     * browser opens six to a server. Server-sent events by hand: `EventSource` sends no token.
     */
    async watchBakes(show: (bake: Bake) => void, signal: AbortSignal): Promise<void> {
        const response = await this.request('GET', '/v1/bakes/events', undefined, undefined, signal);
        const reader = response.body!.pipeThrough(new TextDecoderStream()).getReader();
        let text = '';
        while (true) {
            const {value, done} = await reader.read().catch(error => { throw this.broken(error, signal); });
            if (done) return;
            const events = (text + value).split('\n\n');
            text = events.pop()!;
            for (const event of events) {
                const data = event.split('\n').find(line => line.startsWith('data: '));
                if (data !== undefined) show(JSON.parse(data.slice(6)) as Bake);
            }
        }
    }

    private broken(error: unknown, signal?: AbortSignal): unknown {
        if (signal?.aborted) return error;
        this.lose();
        return new Unreachable('the server does not answer');
    }

    private async refusal(response: Response): Promise<ApiError> {
        const problem = await response.json().catch(() => ({})) as Record<string, string>;
        if (response.status === 401) this.connection.unauthorized();
        const {field, value = ''} = problem;
        const detail = (problem.detail ?? `the server answered ${response.status}`).replace(/^body: /, '');
        const isNamed = value === '' || detail.includes(value);
        const title = this.titles.get(value);
        const words = isNamed ? detail : title === undefined ? `${detail} (${field}: ${value})` : `${detail}: ${title}`;
        const isGone = response.status === 404 && title !== undefined;
        return new ApiError(response.status, problem.code ?? 'unknown',
                            isGone ? `${words} (it was deleted)` : words, field);
    }

    /** Notices a server that dies while the page asks nothing. */
    async attend(): Promise<never> {
        while (true) {
            await new Promise(resolve => setTimeout(resolve, kAttendMilliseconds));
            if (!document.hidden && !this.isLost) await fetch('/readyz').catch(() => this.lose());
        }
    }

    private lose(): void {
        if (this.isLost) return;
        this.isLost = true;
        this.connection.lost();
        void this.awaitReturn();
    }

    private async awaitReturn(): Promise<void> {
        while (this.isLost) {
            await new Promise(resolve => setTimeout(resolve, 1000));
            const answer = await fetch('/readyz').catch(() => null);
            if (answer?.ok) this.find();
        }
    }

    private find(): void {
        if (!this.isLost) return;
        this.isLost = false;
        this.connection.found();
    }
}

async function kept(answer: Response): Promise<Kept> {
    return {file: await answer.json() as StoredFile, isNew: answer.status === 201};
}

/** Whether a bake was ordered for a scene, by its id or by one of its names. */
export function isOfScene({request}: Bake, {id, names}: StoredFile): boolean {
    const scene = request?.scene;
    return scene === id || names.includes(scene as string);
}

/** What to call what may have no name. */
export function titleOf({name, id}: {name: string; id: string}): string {
    return name || id.slice(0, 8);
}

/** All names of a stored file. */
export function namesOf({names, id}: StoredFile): string {
    return titleOf({name: names.join(', '), id});
}

export function messageOf(error: unknown): string {
    return error instanceof Error ? error.message : String(error);
}
