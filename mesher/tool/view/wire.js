// The web socket: commands out, messages in. After the server was away the page begins anew.

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

export class Wire {
  constructor(receive, lost) {
    this.receive = receive;
    this.lost = lost;
    this.tag = 0;
    this.connect();
  }

  connect() {
    const socket = new WebSocket(`ws://${location.host}${location.pathname}socket`);
    socket.binaryType = 'arraybuffer';
    socket.onmessage = (event) => {
      this.lost(false);
      if (typeof event.data === 'string') {
        this.receive(JSON.parse(event.data), {});
      } else {
        const {head, arrays} = decode(event.data);
        this.receive(head, arrays, event.data.byteLength);
      }
    };
    socket.onclose = () => {
      this.lost(true);
      setTimeout(() => this.connect(), 500);
    };
    this.socket = socket;
  }

  // Its tag, which comes back with the answer; 0 if there is no server.
  send(command) {
    if (this.socket.readyState !== WebSocket.OPEN) return 0;
    command.tag = ++this.tag;
    this.socket.send(JSON.stringify(command));
    return this.tag;
  }
}
