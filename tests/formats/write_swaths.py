#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes small recordings of swaths as their specifications have them, with nothing of insonify: old.gsf (version 2),
arrays.gsf (version 3), angles.xtf and steps.xtf (R2Sonic, 'BTH0' in X41) and swath.kmall (410224).

  write_swaths.py FOLDER
"""
import os
import struct
import sys


def gsf_record(kind, data, checked=False):
    data += bytes(-len(data) % 4)
    if checked:
        return struct.pack('>III', len(data), kind | 1 << 31, sum(data)) + data
    return struct.pack('>II', len(data), kind) + data


def gsf_sub(number, data):
    return struct.pack('>I', number << 24 | len(data)) + data


def gsf_scales(rows):
    data = struct.pack('>I', len(rows))
    for number, flags, multiplier, offset in rows:
        data += struct.pack('>BBHii', number, flags, 0, multiplier, offset)
    return gsf_sub(100, data)


def gsf_ping(beams, subrecords, height, ping=0):
    data = struct.pack('>IIiiHHHHhiHhhhHH', 1500000000 + ping, 250000000, -714567890, 541234567, beams, beams // 2, 0, 0,
                       -34, 157, 12345, -210, 175, 12, 20000, 389)
    if height:
        data += struct.pack('>iiih', 3062, 44125, 5500, 0)
    return data + b''.join(subrecords)


def gsf_files(folder):
    header = gsf_record(1, b'GSF-v02.09\0\0')
    scales = gsf_scales([(1, 0, 100, 0), (2, 0, 50, 0), (7, 0, 2, 0)])
    old = [gsf_sub(1, struct.pack('>3H', 2000, 0, 1850)), gsf_sub(2, struct.pack('>3h', -1500, 0, 1500)),
           gsf_sub(7, struct.pack('>3B', 120, 0, 255)), gsf_sub(16, bytes([0, 1, 5]))]
    with open(os.path.join(folder, 'old.gsf'), 'wb') as out:
        out.write(header + gsf_record(99, b'unknown') + gsf_record(2, gsf_ping(3, [scales] + old, False)))

    scales = gsf_scales([(1, 0x20, 100, -3890), (2, 0x40, 1000, 0), (3, 0x20, 20, 7), (4, 0x40, 1000000, 0),
                         (5, 0x20, 180, 0), (6, 0x20, 10, 0), (10, 0x10, 100, 0), (14, 0x40, 10, 5), (17, 0x10, 4, 0),
                         (18, 0x20, 180, 0), (19, 0x20, 100, 0), (20, 0x20, 100, 0), (31, 0x20, 3, 0)])
    one = [scales, gsf_sub(1, struct.pack('>5H', 10000, 20000, 30000, 40000, 65535)),
           gsf_sub(2, struct.pack('>5i', -400000, -1, 0, 1, 400000)), gsf_sub(3, struct.pack('>5h', -20, -10, 0, 10, 20)),
           gsf_sub(4, struct.pack('>5I', 5000000, 4000000, 3000000, 4000000, 5000000)),
           gsf_sub(5, struct.pack('>5h', -9000, -4500, 0, 4500, 9000)),
           gsf_sub(6, struct.pack('>5h', -300, -299, -298, -297, 1000)),
           gsf_sub(10, struct.pack('>5b', -128, -1, 0, 1, 127)),
           gsf_sub(14, struct.pack('>5I', 100, 200, 300, 400, 4294967295)), gsf_sub(15, bytes([0b00011011, 0b10000000])),
           gsf_sub(16, bytes([0, 1, 2, 4, 8])), gsf_sub(17, struct.pack('>5b', -4, -2, 0, 2, 4)),
           gsf_sub(18, struct.pack('>5H', 32400, 32400, 16200, 0, 0)), gsf_sub(19, struct.pack('>5H', 196, 98, 0, 98, 196)),
           gsf_sub(20, struct.pack('>5H', 392, 196, 0, 196, 392)), gsf_sub(31, struct.pack('>5H', 3, 6, 9, 12, 15)),
           gsf_sub(21, b'series'), gsf_sub(131, bytes(70)), gsf_sub(200, b'of a later version')]
    two = [gsf_scales([(1, 0x20, 200, 0)]), gsf_sub(1, struct.pack('>5H', 1, 2, 3, 4, 5)),
           gsf_sub(2, struct.pack('>5i', 1000, 2000, 3000, 4000, 5000))]
    profile = struct.pack('>IIIIiiI', 1499999999, 0, 1500000000, 500000000, -714567890, 541234567, 2)
    profile += struct.pack('>4I', 0, 149025, 1250, 148100)
    attitude = struct.pack('>IIH', 1500000000, 0, 2) + struct.pack('>HhhhH', 0, -100, 200, 5, 9000)
    attitude += struct.pack('>HhhhH', 500, 100, -200, -5, 35999)
    comment = struct.pack('>III', 1500000000, 0, 5) + b'made\0'
    with open(os.path.join(folder, 'arrays.gsf'), 'wb') as out:
        out.write(gsf_record(1, b'GSF-v03.08\0\0') + gsf_record(3, profile) + gsf_record(6, comment, True) +
                  gsf_record(2, gsf_ping(5, one, True), True) + gsf_record(12, attitude) +
                  gsf_record(2, gsf_ping(5, two, True, 1)) + gsf_record(10, b'single'))


def section(name, data):
    data += bytes(-len(data) % 4)
    return name + struct.pack('>H', 4 + len(data)) + data


def bth0(number, points, sections):
    head = struct.pack('>12s12sIII', b'2024', b'100017', 1500000000, 250000000 + 1000 * number, 70000 + number)
    head += struct.pack('>7f', 0.25, 1500, 4e5, 220.5, 3.5e-5, 0.0175, 0.009)
    head += struct.pack('>2fHh', 0.1, 0.2, 29000, -150) + struct.pack('>7f', 6e4, 37182.5, 75, 11, 15, 96, 0.5)
    head += struct.pack('>IHH', 0, 0, points)
    body = section(b'H0', head) + b''.join(section(name, data) for name, data in sections)
    return struct.pack('>4sII', b'BTH0', 12 + len(body), 0) + body


def xtf_packet(kind, data, channels=1):
    data += bytes(-(14 + len(data)) % 64)
    return struct.pack('<HBBHHHI', 0xFACE, kind, 0, channels, 0, 0, 14 + len(data)) + data


def xtf_ping(packet, pitch, roll, heave):
    head = bytearray(256 - 14)
    struct.pack_into('<HBBBBBB', head, 0, 2017, 7, 14, 2, 40, 0, 25)
    struct.pack_into('<f', head, 32 - 14, 750)
    struct.pack_into('<dd', head, 128 - 14, 54.125, 7.75)
    struct.pack_into('<f', head, 192 - 14, 1.5)
    struct.pack_into('<4f', head, 204 - 14, pitch, roll, 40.0, heave)
    return xtf_packet(65, bytes(head) + packet)


def xtf_file(path, packets):
    head = bytearray(1024)
    struct.pack_into('<BB8s8s16s', head, 0, 123, 0, b'writer', b'1', b'2024')
    struct.pack_into('<HHH', head, 164, 3, 0, 1)
    attitude = bytearray(64 - 14)
    struct.pack_into('<4fIfHBBBBBHB', attitude, 16, 2, -3, 0.25, 0, 0, 45, 2017, 7, 14, 2, 40, 1, 500, 0)
    with open(path, 'wb') as out:
        out.write(bytes(head) + xtf_packet(3, bytes(attitude)) + b''.join(packets) + xtf_packet(107, b'later'))


def xtf_files(folder):
    times = struct.pack('>f5H', 2e-6, 20000, 15000, 10000, 15000, 0)
    equal = bth0(0, 5, [(b'R0', times), (b'A0', struct.pack('>8f', -1, 1, *[0] * 6)), (b'Z9', b'later'),
                        (b'I1', struct.pack('>f5H', 0.5, 2000, 4000, 8000, 0, 2)),
                        (b'G1', struct.pack('>f10B', 1e-4, *range(1, 11)))])
    steps = bth0(1, 3, [(b'R0', struct.pack('>f3H', 2e-6, 20000, 10000, 20000)),
                        (b'A2', struct.pack('>8f3H', -0.75, 1e-4, *[0] * 6, 0, 7500, 7500)),
                        (b'G0', struct.pack('>3f', 0.01, 0.05, 0.1)), (b'Q0', bytes([0xb7, 0x10]))])
    xtf_file(os.path.join(folder, 'angles.xtf'), [xtf_ping(equal, 0, 0, 0)])
    xtf_file(os.path.join(folder, 'steps.xtf'), [xtf_ping(equal, 0, 0, 0), xtf_ping(steps, 3, -5, 0.25)])


def kmall(kind, data, version=0, second=0):
    size = 24 + len(data)
    head = struct.pack('<I4sBBHII', size, kind, version, 40, 2040, 1500000000 + second, 125000000)
    return head + data + struct.pack('<I', size)


def mrz(second, version):
    """A swath of three soundings and an extra one. From version 1 on sectors are longer, from 2 on the part of the ping."""
    sector = 36 if version == 0 else 48
    longer = struct.pack('<fBBH', 0.5, 1, 0, 0) if version == 2 else b''
    common = struct.pack('<HHBBBBBBBB', 12, 77 + second, 1, 0, 1, 0, 0, 0, 1, 0)
    info = struct.pack('<HHf6BH', 144 + len(longer), 0, 4.5, 0, 1, 0, 0, 0, 0, 0)
    info += struct.pack('<11f', 3e5, 2e5, 4e5, 1e-4, 1e-4, 6e4, 96, 60, -60, 58, -58)
    info += struct.pack('<hhBBHI', 10, -10, 0, 0, 0, 0) + struct.pack('<3fHHf', 1, 1, 0, 0, 0, 0)
    info += struct.pack('<HH6f4B', 2, sector, 123.45, 1487.5, 1.75, -0.5, 0, 0, 0, 0, 0, 0)
    info += struct.pack('<ddf', 54.1234567, -7.7654321, 47.5) + longer
    sectors = bytes(2 * sector)
    receiver = struct.pack('<4H4f4H', 32, 3, 2, 120, 0, 0, -20, -30, 0, 1, 2, 4)
    soundings = b''
    for i in range(4):
        soundings += struct.pack('<H8BH', i, 0, (0, 2, 0, 1)[i], (2, 1, 0, 1)[i], 0, 0, 0, 0, 0, 0)
        soundings += struct.pack('<6f', 100, 0.1, 0.0625 * (i + 1), 0.125 * (i + 1), 0, 0)
        soundings += struct.pack('<HH', 0, 0) + struct.pack('<4f', 0, 0, -25.5 - i, -99)
        soundings += struct.pack('<8f', 0, 0, 0, 0, 0, 0, 0.03125 * (i + 1), 0)
        soundings += struct.pack('<6f4H', 0, 0, 20.25 + i, -15.5 + 10 * i, 0.75 * i, 0, 0, 0, 0, 0)
    return kmall(b'#MRZ', struct.pack('<HH', 1, 1) + common + info + sectors + receiver + bytes(2 * 4) + soundings,
                 version, second)


def kmall_file(folder):
    profile = struct.pack('<HH4sIdd', 28, 2, b'S00', 1499999000, 54, -7)
    profile += struct.pack('<ffIff', 0, 1490.25, 0, 0, 0) + struct.pack('<ffIff', 12.5, 1481, 0, 0, 0)
    motion = struct.pack('<HBBHHHH', 12, 1, 0, 0, 2, 132, 7)
    for i in range(2):
        motion += struct.pack('<4sHHIII', b'#KMB', 120, 1, 1500000000, 500000000 * i, 0) + struct.pack('<dd', 54, -7)
        motion += struct.pack('<21f', 47, 2.5 + i, -1.25, 120 + i, 0.125, *[0] * 16) + bytes(12)
    position = struct.pack('<4H', 8, 0, 0, 0) + bytes(40) + b'$GPGGA'
    with open(os.path.join(folder, 'swath.kmall'), 'wb') as out:
        out.write(kmall(b'#IIP', struct.pack('<HHH', 6, 0, 0) + b'EM2040') + kmall(b'#SVP', profile, 1) +
                  kmall(b'#SKM', motion, 1) + kmall(b'#SPO', position) + mrz(0, 0) + mrz(1, 2))


if __name__ == '__main__':
    gsf_files(sys.argv[1])
    xtf_files(sys.argv[1])
    kmall_file(sys.argv[1])
