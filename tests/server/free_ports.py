# SPDX-License-Identifier: Apache-2.0
"""Ports for programs that cannot choose one themselves."""
import random
import socket


def is_free(port):
    try:
        socket.create_server(("127.0.0.1", port)).close()
    except OSError:
        return False
    return True


def free_ports(count):
    """Different ones of 127.0.0.1, below those that Linux gives to other programs (from 32768 on): none takes one before
    its program starts, or while that is started again."""
    ports = set()
    while len(ports) < count:
        port = random.randrange(20000, 32768)
        if is_free(port):
            ports.add(port)
    return list(ports)
