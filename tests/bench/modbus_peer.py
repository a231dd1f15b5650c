"""The peer of gyrocal's Modbus client: pymodbus at the same requests.

modbus_peer.py HOST PORT reads the simulated chamber as the Yinhe profile does, and prints the wall
seconds of a reading as JSON. Exit code 3: pymodbus is not installed.
"""
import json
import sys
import time

import peer_clock

try:
    import pymodbus
    from pymodbus.client import ModbusTcpClient
except ImportError:
    sys.exit(3)

REGISTERS = [(160, 2), (1742, 2), (200, 1), (202, 1)]


def main():
    client = ModbusTcpClient(sys.argv[1], port=int(sys.argv[2]))
    assert client.connect()
    taken = []
    for _ in range(300):
        before = time.monotonic()
        for address, count in REGISTERS:
            assert len(client.read_holding_registers(address, count, slave=1).registers) == count
        taken.append(time.monotonic() - before)
    client.close()
    print(json.dumps({"version": str(pymodbus.__version__), "wall_s": peer_clock.spread(taken)}))


main()
