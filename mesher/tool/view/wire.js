// The web socket: commands out, messages in. When the server is away, it is looked for at longer and
// longer intervals; when it is back, it sends all of the mesh.

// A Message (message.hpp): its head, and its arrays by name, which are views of `buffer`.
export function decode(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const types = {f64: Float64Array, u32: Uint32Array, u8: Uint8Array};
  const arrays = {};
  for (const {name, type, at, length: items} of head.arrays || []) {
    arrays[name] = new types[type](buffer, 4 + length + at, items);
  }
  return {head, arrays};
}

const FIRST_WAIT = 250, LONGEST_WAIT = 8000;  // milliseconds

export class Wire {
  // lost: called with {refused, wait}: milliseconds until the next attempt, and whether something at
  // the address refuses this page; with null when the server is there.
  constructor(receive, lost) {
    this.receive = receive;
    this.lost = lost;
    this.tag = 0;
    this.wait = FIRST_WAIT;
    this.timer = 0;
    window.addEventListener('online', () => this.try_now());
    document.addEventListener('visibilitychange', () => {
      if (document.visibilityState === 'visible') this.try_now();
    });
    this.connect();
  }

  connect() {
    clearTimeout(this.timer);
    this.timer = 0;
    const socket = new WebSocket(`ws://${location.host}${location.pathname}socket`);
    socket.binaryType = 'arraybuffer';
    socket.onmessage = (event) => {
      this.wait = FIRST_WAIT;
      this.lost(null);
      if (typeof event.data === 'string') {
        this.receive(JSON.parse(event.data), {});
      } else {
        const {head, arrays} = decode(event.data);
        this.receive(head, arrays, event.data.byteLength);
      }
    };
    socket.onclose = () => this.closed();
    this.socket = socket;
  }

  async closed() {
    const wait = this.wait;
    this.wait = Math.min(LONGEST_WAIT, 2 * wait);
    this.timer = setTimeout(() => this.connect(), wait);
    this.lost({refused: false, wait});
    // A web socket does not tell whether nobody answers, or somebody who does not know this page.
    const timer = this.timer;
    const answer = await fetch('style.css', {method: 'HEAD', cache: 'no-store'}).catch(() => null);
    if (this.timer === timer && answer && answer.status === 403) this.lost({refused: true, wait});
  }

  // Looks for the server at once, if it is away.
  try_now() {
    if (this.timer === 0) return;
    this.wait = FIRST_WAIT;
    this.connect();
  }

  // Its tag, which comes back with the answer; 0 if there is no server.
  send(command) {
    if (this.socket.readyState !== WebSocket.OPEN) return 0;
    command.tag = ++this.tag;
    this.socket.send(JSON.stringify(command));
    return this.tag;
  }
}
