// Prints all messages and metadata of an MCAP file as JSON, read by @mcap/core and @foxglove/rosmsg2-serialization, chunks
// unpacked by fzstd and lz4js:
// node read_mcap.cjs FILE. Packages are found by NODE_PATH.
"use strict";
const fs = require("node:fs/promises");
const { McapIndexedReader } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");

/// A package, or null where it is not installed.
function optional(name) {
  try {
    return require(name);
  } catch {
    return null;
  }
}

function unpackers() {
  const zstd = optional("fzstd"), lz4 = optional("lz4js"), handlers = {};
  if (zstd) handlers.zstd = (bytes, size) => zstd.decompress(bytes, new Uint8Array(Number(size)));
  if (lz4) handlers.lz4 = (bytes, size) => lz4.decompress(bytes, Number(size));
  return handlers;
}

async function main(path) {
  const file = await fs.open(path);
  const readable = {
    size: async () => BigInt((await file.stat()).size),
    read: async (offset, size) => {
      const bytes = new Uint8Array(Number(size));
      const { bytesRead } = await file.read(bytes, 0, bytes.length, Number(offset));
      if (bytesRead !== bytes.length) throw new Error(`cut off at byte ${Number(offset) + bytesRead}`);
      return bytes;
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers: unpackers() });
  const readers = new Map();
  const messages = [];
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(message.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    if (!readers.has(channel.schemaId)) {
      const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
      readers.set(channel.schemaId, new MessageReader(definition));
    }
    messages.push({
      topic: channel.topic,
      type: schema.name,
      metadata: Object.fromEntries(channel.metadata),
      time: message.logTime.toString(),
      sequence: message.sequence,
      content: readers.get(channel.schemaId).readMessage(message.data),
    });
  }
  const metadata = {};
  for await (const record of reader.readMetadata()) metadata[record.name] = Object.fromEntries(record.metadata);
  const compressions = [...new Set(reader.chunkIndexes.map((chunk) => chunk.compression))];
  await file.close();
  const plain = (key, value) => (ArrayBuffer.isView(value) ? Array.from(value) : typeof value === "bigint" ? Number(value) : value);
  console.log(JSON.stringify({ profile: reader.header.profile, metadata, compressions, messages }, plain));
}

main(process.argv[2]).catch((error) => {
  console.error(String(error.message ?? error));
  process.exit(1);
});
