// SPDX-License-Identifier: Apache-2.0
// Volumes and answers of the command `tetralight`, which the tests compare with. Without TETRALIGHT_COMMAND, the built
// command, these tests are skipped.
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

export const kCommand = process.env.TETRALIGHT_COMMAND ?? '';
export const kCourtyard = process.env.TETRALIGHT_COURTYARD ?? '';

type Position = readonly [number, number, number];

export interface Group {
    name: string;
    positions: readonly Position[];
    rendering_layers?: number[];
}

/** An answer of `query --to jsonl`. */
export interface Answer {
    cell: number | null;
    probes: {probe: number; weight: number}[];
    ambient: number;
    irradiance_sh: number[][];
    occlusion: number[];
}

/** A folder of its own for the files of one test. */
export class Folder {
    private readonly path = mkdtempSync(join(tmpdir(), 'tetralight-'));

    file(name: string): string {
        return join(this.path, name);
    }

    remove(): void {
        rmSync(this.path, {recursive: true, force: true});
    }

    run(...args: string[]): string {
        return execFileSync(kCommand, args, {cwd: this.path, encoding: 'utf8', maxBuffer: 1 << 28,
                                             stdio: ['ignore', 'pipe', 'pipe']});
    }

    bytes(name: string): Uint8Array {
        return new Uint8Array(readFileSync(this.file(name)));
    }

    writeGroups(groups: readonly Group[]): void {
        writeFileSync(this.file('groups.json'), JSON.stringify({groups}));
    }

    /** A volume without light. */
    tetrahedralize(groups: readonly Group[]): Uint8Array {
        this.writeGroups(groups);
        this.run('tetrahedralize', 'groups.json', '-o', 'volume.probes', '--quiet');
        return this.bytes('volume.probes');
    }

    /** The light of the courtyard at these groups, or at its own. */
    bake(groups: readonly Group[] | undefined, ...options: string[]): Uint8Array {
        const given = groups ? ['--groups', 'groups.json', '--only-given-groups'] : [];
        if (groups) this.writeGroups(groups);
        this.run('bake', kCourtyard, ...given, '-o', 'volume.probes', '--samples', '4', '--quiet', ...options);
        return this.bytes('volume.probes');
    }

    /** Answers of `volume.probes`. `rows` has three numbers a position, or six with `--normals`. */
    query(rows: Float32Array, ...options: string[]): Answer[] {
        writeFileSync(this.file('positions.f32'), new Uint8Array(rows.buffer, rows.byteOffset, rows.byteLength));
        const text = this.run('query', 'volume.probes', 'positions.f32', '--to', 'jsonl', '--quiet', ...options);
        return text.trim().split('\n').map(line => JSON.parse(line) as Answer);
    }
}
