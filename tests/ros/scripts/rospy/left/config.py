SIDE = "left"
SEED = 1
