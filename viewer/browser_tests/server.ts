// SPDX-License-Identifier: Apache-2.0
// A real `tetralight serve` on a port and a folder of its own.
import {ChildProcess, spawn, spawnSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';

const kRoot = resolve(fileURLToPath(import.meta.url), '../../..');
export const kCommand = process.env.TETRALIGHT_COMMAND ?? join(kRoot, 'build/release/tetralight');
export const kCourtyard = process.env.TETRALIGHT_COURTYARD ?? join(kRoot, 'examples/scenes/courtyard.glb');
export const kViewer = process.env.TETRALIGHT_VIEWER ?? join(kRoot, 'build/viewer');

export class Server {
    url = '';
    private process: ChildProcess | null = null;
    private port = 0;

    constructor(private readonly token = '',
                readonly folder = mkdtempSync(join(tmpdir(), 'tetralight_viewer_')),
                private readonly viewer = kViewer) {}

    async start(): Promise<this> {
        const options = ['serve', '--data', join(this.folder, 'data'), '--viewer', this.viewer,
                         '--listen', `127.0.0.1:${this.port}`, '--log', 'error'];
        const env = {...process.env, ...(this.token === '' ? {} : {TETRALIGHT_TOKEN: this.token})};
        const child = spawn(kCommand, options, {env, stdio: ['ignore', 'pipe', 'inherit']});
        this.process = child;
        const line = await new Promise<string>((done, fail) => {
            child.stdout!.once('data', (bytes: Buffer) => done(bytes.toString()));
            child.once('error', fail);
            child.once('exit', code => fail(new Error(`the server ended with ${code}`)));
        });
        this.port = Number(/:(\d+)\s*$/.exec(line)![1]);
        this.url = `http://127.0.0.1:${this.port}`;
        return this;
    }

    /** What a power cut leaves of it; `start` then takes the same port. */
    async kill(): Promise<void> {
        const child = this.process;
        if (child === null) return;
        const over = new Promise(done => child.once('exit', done));
        child.kill('SIGKILL');
        await over;
        this.process = null;
    }

    async end(): Promise<void> {
        await this.kill();
        rmSync(this.folder, {recursive: true, force: true});
    }

    async request<T>(method: string, path: string, body?: BodyInit): Promise<T> {
        const headers: Record<string, string> = {
            'Content-Type': typeof body === 'string' ? 'application/json' : 'application/octet-stream',
        };
        if (this.token !== '') headers.Authorization = `Bearer ${this.token}`;
        const answer = await fetch(this.url + path, {method, headers, body});
        if (!answer.ok) throw new Error(`${method} ${path}: ${answer.status} ${await answer.text()}`);
        return (answer.status === 204 ? undefined : await answer.json()) as T;
    }

    async uploadCourtyard(): Promise<string> {
        const {id} = await this.request<{id: string}>('POST', '/v1/scenes?name=courtyard', readFileSync(kCourtyard));
        return id;
    }

    /** Bakes and waits; gives the volume. */
    async bake(order: Record<string, unknown>): Promise<string> {
        const {id} = await this.request<{id: string}>('POST', '/v1/bakes', JSON.stringify(order));
        while (true) {
            const bake = await this.request<{state: string; volume: string; error: string}>('GET', `/v1/bakes/${id}`);
            if (bake.state === 'done') return bake.volume;
            if (bake.state === 'failed') throw new Error(bake.error);
            await new Promise(done => setTimeout(done, 100));
        }
    }
}

/** Runs the command itself. */
export function run(...args: string[]): string {
    const {stdout, stderr, status} = spawnSync(kCommand, args, {encoding: 'utf8'});
    if (status !== 0) throw new Error(stderr);
    return stdout;
}
