SIDE = "right"
SEED = 2
