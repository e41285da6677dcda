namespace reachlab {}
