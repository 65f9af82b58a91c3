// SPDX-License-Identifier: Apache-2.0
// A file server for pages that are not the viewer's: the repository, and a folder as /made/.
import {createReadStream} from 'node:fs';
import {createServer, Server as HttpServer} from 'node:http';
import {AddressInfo} from 'node:net';
import {extname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';

const kRoot = resolve(fileURLToPath(import.meta.url), '../../..');
const kTypes: Record<string, string> = {
    '.html': 'text/html', '.js': 'text/javascript', '.png': 'image/png',
};

export class FileServer {
    url = '';
    private server: HttpServer | null = null;

    constructor(private readonly made: string) {}

    async start(): Promise<this> {
        const server = createServer((request, answer) => {
            const {pathname} = new URL(request.url!, 'http://here');
            const path = pathname.startsWith('/made/') ? join(this.made, pathname.slice(6)) : join(kRoot, pathname);
            answer.setHeader('Content-Type', kTypes[extname(path)] ?? 'application/octet-stream');
            createReadStream(path).on('error', () => answer.writeHead(404).end()).pipe(answer);
        });
        await new Promise<void>(done => server.listen(0, '127.0.0.1', done));
        this.server = server;
        this.url = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
        return this;
    }

    end(): void {
        this.server?.closeAllConnections();
        this.server?.close();
    }
}
